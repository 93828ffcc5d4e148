// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/frame.h"
#include "io/bake_writer.h"
#include "recording/bake_description.h"

namespace throng::test {

struct SampleOptions {
    std::uint32_t rows = 64;
    std::uint32_t frames = 48;
    glm::dvec2 origin{0.0};           ///< world position of the crossing; also the streams' origin
    std::uint32_t diagram_every = 0;  ///< 0 = none
    std::uint32_t gltf_agents = 2000;
    bool gltf = true;
    bool force = false;
    StreamFormats formats = StreamFormats::standard();
    bool every_stream = false;  ///< on a slope, with all streams from the device
};

/// A diagram of the given sites by brute force; `site` and `distance` back the image's spans.
struct SampleDiagram {
    SampleDiagram(const std::vector<glm::vec2>& sites, std::uint32_t agent_count, glm::vec2 minimum,
                  std::uint32_t width, std::uint32_t height, float pixels_per_metre, float tile_radius);

    std::vector<std::uint32_t> site;
    std::vector<float> distance;
    DiagramImage image;
};

/// A crowd that needs no simulation: two flows cross at right angles, each person swaying along a straight
/// lane, as functions of row and frame. Every fifth row enters late, those at the end of their lane leave,
/// and the last of three rows or more never finds room. Rows that have not entered hold -999, which no file
/// may ever show.
class SampleCrowd {
  public:
    explicit SampleCrowd(SampleOptions options) : options_(options) {}

    recording::BakeDescription description(const std::filesystem::path& output) const;
    Account account() const;
    /// Makes the frames [0, count).
    void makeFrames(std::uint32_t count, const std::function<void(const Frame&)>& take) const;
    /// Writes them, and their diagrams.
    void writeTo(io::BakeWriter& writer, std::uint32_t count) const;
    /// A whole bake; returns what the writer returns.
    io::BakeResult bake(const std::filesystem::path& output) const;

    bool isRefused(std::uint32_t row) const { return options_.rows > 2 && row + 1 == options_.rows; }
    std::uint32_t spawnFrame(std::uint32_t row) const;
    /// The first frame in which the row has left; the number of frames or more when it does not leave in
    /// time.
    std::uint32_t arrivalFrame(std::uint32_t row) const;
    bool isAlive(std::uint32_t row, std::uint32_t frame) const;
    /// Where it is (m, relative to the crossing), clamped to its time in the scene.
    glm::dvec2 position(std::uint32_t row, std::uint32_t frame) const;
    double heading(std::uint32_t row, std::uint32_t frame) const;  ///< rad
    double phase(std::uint32_t row, std::uint32_t frame) const;    ///< cycles
    /// Of a stream that not every bake has: something that tells its own place; 0 where nobody is, if the
    /// stream comes from the device.
    float extra(const StreamInfo& info, std::uint32_t row, std::uint32_t frame, std::size_t component) const;

  private:
    double distance(std::uint32_t row, std::uint32_t frame) const;
    double speed(std::uint32_t row) const { return 1.1 + 0.1 * (row % 4); }
    PerStream<std::vector<float>> valuesOf(std::uint32_t frame) const;
    SampleDiagram diagramOf(std::uint32_t index) const;
    Frame frameOf(std::uint32_t index, const PerStream<std::vector<float>>& values) const;

    SampleOptions options_;
};

/// The bytes of a file; none where it is not there.
std::string contentOf(const std::filesystem::path& path);

/// A folder of its own for each test, removed at the end.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    /// Names inside, sorted.
    std::vector<std::string> names() const;

  private:
    std::filesystem::path path_;
};

}  // namespace throng::test
