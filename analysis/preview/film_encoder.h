// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

#include "analysis/preview/film_planes.h"
#include "analysis/preview/plate.h"
#include "base/process.h"

namespace throng::analysis {

/// ffmpeg, which takes raw frames. A thread hands them over while the next ones are drawn.
class FilmEncoder {
  public:
    /// @throws OutputError where there is no ffmpeg
    FilmEncoder(const Plate& plate, const std::filesystem::path& path);
    /// What is not finished is given up.
    ~FilmEncoder();

    /// A canvas of the plate's to draw on; waits until one is free. @throws OutputError where the film could
    /// not go on
    cairo_surface_t* freeCanvas();
    /// The next frame, on a canvas from freeCanvas().
    void add(cairo_surface_t* canvas);
    /// @throws OutputError
    void finish();

  private:
    void handOver(cairo_surface_t* canvas);
    void handOverAll();
    void join();

    std::filesystem::path path_;
    FilmPlanes planes_;
    Process process_;
    std::vector<Surface> canvases_;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<cairo_surface_t*> free_, drawn_;
    bool is_closing_ = false;
    std::exception_ptr failure_;
    std::thread thread_;
};

}  // namespace throng::analysis
