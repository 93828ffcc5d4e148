// SPDX-License-Identifier: Apache-2.0
#include "analysis/preview/film_encoder.h"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <thread>

#include "base/files/output_file.h"

namespace throng::analysis {
namespace {

constexpr int kCanvases = 3;  // one is drawn on, one is handed over, and one waits for either

std::vector<std::string> wordsFor(const Plate& plate, const std::filesystem::path& path) {
    // Without -xerror it ends well where the last of the film found no room on the disk.
    std::vector<std::string> words = {"ffmpeg", "-loglevel", "error", "-nostdin", "-xerror", "-y"};
    const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
    add({"-f", "rawvideo", "-pix_fmt", "yuv420p", "-s", fmt::format("{}x{}", plate.width(), plate.height())});
    add({"-r", fmt::format("{}", plate.fps()), "-i", "-"});
    // Looking ahead would make files a fifth smaller and cost as much as a third of the encoding; arithmetic
    // coding a fourteenth smaller, for a sixth. A plate has neither cuts nor fades: to look for them is a
    // tenth.
    add({"-c:v", "libx264", "-preset", "superfast"});
    add({"-x264-params", "rc-lookahead=0:mbtree=0:bframes=0:cabac=0:scenecut=0:weightp=0"});
    // As many threads as there are cores: half more, as it has them by itself, are in the way of the next
    // frame's drawing.
    const unsigned threads = std::clamp(std::thread::hardware_concurrency(), 1u, 16u);
    add({"-threads", fmt::format("{}", threads), "-pix_fmt", "yuv420p", "-crf", "22", "-f", "mp4",
         path.string()});
    return words;
}

/// In place, as what is a process cannot be moved.
Process started(const std::vector<std::string>& words, const std::filesystem::path& path) {
    try {
        ProcessOptions options{.input = StandardStream::pipe};
        // Or else glibc gives the pages of each frame back to the system, which has to find and clear others
        // for the next: a tenth of all time.
        for (const char* name : {"MALLOC_MMAP_THRESHOLD_", "MALLOC_TRIM_THRESHOLD_"})
            options.environment.emplace_back(name, "268435456");
        return Process(words, options);
    } catch (const std::system_error& error) {
        if (error.code() != std::errc::no_such_file_or_directory)
            throw OutputError(path, "start ffmpeg for", error.code().value());
        throw OutputError(path, "films need the program ffmpeg, which is not here: apt-get install ffmpeg");
    }
}

}  // namespace

FilmEncoder::FilmEncoder(const Plate& plate, const std::filesystem::path& path)
    : path_(path), planes_(plate.width(), plate.height()), process_(started(wordsFor(plate, path), path)) {
    for (int i = 0; i < kCanvases; ++i) {
        canvases_.push_back(plate.makeCanvas());
        free_.push_back(canvases_.back().get());
    }
    thread_ = std::thread([this] { handOverAll(); });
}

FilmEncoder::~FilmEncoder() {
    if (!thread_.joinable()) return;
    process_.tell(SIGKILL);  // nobody waits for it to read
    join();
}

cairo_surface_t* FilmEncoder::freeCanvas() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failure_ || !free_.empty(); });
    if (failure_) std::rethrow_exception(failure_);
    cairo_surface_t* canvas = free_.front();
    free_.pop_front();
    return canvas;
}

void FilmEncoder::add(cairo_surface_t* canvas) {
    {
        const std::lock_guard lock(mutex_);
        drawn_.push_back(canvas);
    }
    changed_.notify_all();
}

void FilmEncoder::finish() {
    join();
    if (failure_) std::rethrow_exception(failure_);
    const ProgramEnd end = process_.wait();
    if (!end.isGood()) throw OutputError(path_, "ffmpeg could not make the film: it " + end.text());
}

void FilmEncoder::join() {
    {
        const std::lock_guard lock(mutex_);
        is_closing_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void FilmEncoder::handOverAll() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return is_closing_ || !drawn_.empty(); });
        if (drawn_.empty()) return;
        cairo_surface_t* canvas = drawn_.front();
        drawn_.pop_front();
        lock.unlock();
        std::exception_ptr failure;
        try {
            handOver(canvas);
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        failure_ = failure;
        free_.push_back(canvas);
        changed_.notify_all();
        if (failure_) return;
    }
}

void FilmEncoder::handOver(cairo_surface_t* canvas) {
    const auto* pixels = reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(canvas));
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(canvas)) / sizeof *pixels;
    const std::vector<std::uint8_t>& planes = planes_.of(pixels, stride);
    if (const std::error_code error =
            process_.write({reinterpret_cast<const char*>(planes.data()), planes.size()}))
        throw OutputError(path_, "write the film", error.value());
}

}  // namespace throng::analysis
