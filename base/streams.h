// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

/// The streams of a bake, each told once.
///
/// The device's frames, the recorder, the writers and readers, the manifest, `throng apply` and the options
/// that ask for streams all follow kStreams; nothing else lists streams. All hold float32, three for each
/// row.
namespace throng {

inline constexpr std::size_t kComponents = 3;  ///< point caches know no other number

/// In the order of kStreams.
enum class Stream {
    pos,
    dir,
    state,
    density,
    ground,
    wish,
    left_foot,
    right_foot,
    carriage,
    gaze,
    chest,
    attention,
    size
};

/// What a row holds in the frames before it is first alive.
enum class BackFill {
    keep,         ///< what was written; it is zero for whoever is not there
    first_alive,  ///< the value of the first frame in which the row is alive
    zero,
};

/// What a row holds between two frames.
enum class Between {
    nearest,  ///< the value of the nearer frame
    linear,
    heading,  ///< the first two components are a direction, which turns the shorter way round
};

struct StreamComponent {
    std::string_view name;
    std::string_view unit;  ///< "1": none
    BackFill before_entry;
    Between between;
    double step;            ///< of the form `packed`, a power of two: values are off by half of it at most
    bool is_rate = false;   ///< grows with the pace of whoever lives faster, and is zero where time stands
    bool is_whole = false;  ///< all values are whole steps
};

/// What the first two components are in the plane.
enum class InPlane {
    nothing,
    place,      ///< moves with its person, and with the origin
    direction,  ///< turns with its person
};

/// Where the values come from, and so which bakes have the stream.
enum class StreamSource {
    motion,   ///< made of the simulated motion by recording/motion_recorder.h: every bake
    terrain,  ///< likewise: every bake with a terrain
    pose,     ///< likewise: bakes that are asked for them
    device,   ///< packed by a shader of its own and written as it is: bakes that are asked for it
};

inline constexpr double kFinest = 1.0 / 16384.0, kFine = 1.0 / 8192.0, kFair = 1.0 / 2048.0;  ///< steps
constexpr bool kRate = true, kWhole = true;

/// One row of the table.
struct StreamInfo {
    Stream id;
    std::string_view name;   ///< of its files and its entry in bake.json
    std::string_view about;  ///< in words
    std::array<StreamComponent, kComponents> components;
    StreamSource source = StreamSource::motion;
    InPlane in_plane = InPlane::nothing;
    std::string_view shader = {};  ///< of a stream from the device: fills the block StreamBlock, row by row
    bool needs_diagram = false;    ///< that shader reads the frame's diagram: how many pixels each row owns
    std::string_view option = {};  ///< that asks for it, and for others with the same; empty: its name

    constexpr std::string_view asksFor() const { return option.empty() ? name : option; }
};

/// Whether a bake has such streams only where it is asked for them.
constexpr bool isAskedFor(const StreamInfo& info) {
    return info.source == StreamSource::device || info.source == StreamSource::pose;
}

inline constexpr std::array<StreamComponent, kComponents> kFootComponents{
    {{"forward", "m", BackFill::zero, Between::nearest, kFine},
     {"left", "m", BackFill::zero, Between::nearest, kFine},
     {"turn_and_lift", "1", BackFill::zero, Between::nearest, kFine}}};

inline constexpr std::array kStreams = {
    StreamInfo{.id = Stream::pos,
               .name = "pos",
               .about = "where everybody is",
               .components = {{{"x", "m", BackFill::first_alive, Between::linear, kFinest},
                               {"y", "m", BackFill::first_alive, Between::linear, kFinest},
                               {"z", "m", BackFill::first_alive, Between::linear, kFinest}}},
               .in_plane = InPlane::place},
    StreamInfo{.id = Stream::dir,
               .name = "dir",
               .about = "which way everybody faces, and how fast it goes",
               .components = {{{"cos_heading", "1", BackFill::first_alive, Between::heading, kFine},
                               {"sin_heading", "1", BackFill::first_alive, Between::heading, kFine},
                               {"speed", "m/s", BackFill::zero, Between::linear, kFair, kRate}}},
               .in_plane = InPlane::direction},
    StreamInfo{
        .id = Stream::state,
        .name = "state",
        .about = "what everybody does, its looks, and its pose",
        .components = {{{"activity", "1", BackFill::keep, Between::nearest, kFine, !kRate, kWhole},
                        {"variation", "1", BackFill::first_alive, Between::nearest, 1.0, !kRate, kWhole},
                        {"phase", "cycles", BackFill::first_alive, Between::linear, 0.5 * kFair}}}},
    StreamInfo{.id = Stream::density,
               .name = "density",
               .about = "persons per square metre by the area of each person's cell",
               .components = {{{"density", "1/m^2", BackFill::keep, Between::linear, 0.5 * kFair},
                               {"area", "m^2", BackFill::keep, Between::linear, 0.5 * kFair},
                               {"share", "1", BackFill::keep, Between::linear, kFine}}},
               .source = StreamSource::device,
               .shader = "shaders/frame/pack_density.comp",
               .needs_diagram = true},
    StreamInfo{.id = Stream::ground,
               .name = "ground",
               .about = "how the ground under everybody's feet slopes, and how high it is",
               .components = {{{"slope_along", "1", BackFill::first_alive, Between::linear, kFine},
                               {"slope_across", "1", BackFill::first_alive, Between::linear, kFine},
                               {"height", "m", BackFill::first_alive, Between::linear, kFine}}},
               .source = StreamSource::terrain},
    StreamInfo{.id = Stream::wish,
               .name = "wish",
               .about = "the velocity that everybody would like, and how much it has been held up lately",
               .components = {{{"x", "m/s", BackFill::keep, Between::linear, kFair, kRate},
                               {"y", "m/s", BackFill::keep, Between::linear, kFair, kRate},
                               {"held_up", "1", BackFill::keep, Between::linear, kFair}}},
               .source = StreamSource::device,
               .in_plane = InPlane::direction,
               .shader = "shaders/frame/pack_wish.comp"},
    StreamInfo{.id = Stream::left_foot,
               .name = "left_foot",
               .about = "how far the left foot has to be moved from where a clip has it",
               .components = kFootComponents,
               .source = StreamSource::pose,
               .option = "feet"},
    StreamInfo{.id = Stream::right_foot,
               .name = "right_foot",
               .about = "the same of the right foot",
               .components = kFootComponents,
               .source = StreamSource::pose,
               .option = "feet"},
    StreamInfo{.id = Stream::carriage,
               .name = "carriage",
               .about = "how much of a walk is in the pose, and how the trunk turns and leans",
               .components = {{{"walking", "1", BackFill::zero, Between::linear, kFine},
                               {"twist", "rad", BackFill::zero, Between::linear, kFine},
                               {"lean", "rad", BackFill::zero, Between::linear, kFine}}},
               .source = StreamSource::pose,
               .option = "feet"},
    StreamInfo{.id = Stream::gaze,
               .name = "gaze",
               .about = "which way everybody looks, from where the body faces, and at whom",
               .components = {{{"yaw", "rad", BackFill::zero, Between::linear, kFine},
                               {"pitch", "rad", BackFill::zero, Between::linear, kFine},
                               {"at", "1", BackFill::zero, Between::nearest, 1.0, !kRate, kWhole}}},
               .source = StreamSource::pose},
    StreamInfo{
        .id = Stream::chest,
        .name = "chest",
        .about = "which way the chests of people with bodies point, from where they face, and how much room "
                 "they take",
        .components = {{{"twist", "rad", BackFill::keep, Between::linear, kFine},
                        {"turning", "rad/s", BackFill::keep, Between::linear, kFair, kRate},
                        {"width", "m", BackFill::keep, Between::linear, kFine}}},
        .source = StreamSource::device,
        .shader = "shaders/frame/pack_chest.comp"},
    StreamInfo{.id = Stream::attention,
               .name = "attention",
               .about = "which way everybody's head is turned on the chest, and how far it is so turned",
               .components = {{{"yaw", "rad", BackFill::zero, Between::linear, kFine},
                               {"pitch", "rad", BackFill::zero, Between::linear, kFine},
                               {"weight", "1", BackFill::zero, Between::linear, kFine}}},
               .source = StreamSource::pose},
    StreamInfo{.id = Stream::size,
               .name = "size",
               .about = "how much room bodies take: times their own size, and how broad and deep they are",
               .components = {{{"factor", "1", BackFill::first_alive, Between::linear, kFine},
                               {"breadth", "m", BackFill::first_alive, Between::linear, kFine},
                               {"depth", "m", BackFill::first_alive, Between::linear, kFine}}},
               .source = StreamSource::device,
               .shader = "shaders/frame/pack_size.comp"},
};

/// Something for each stream.
template <class T>
class PerStream {
  public:
    T& operator[](Stream stream) { return values_[static_cast<std::size_t>(stream)]; }
    const T& operator[](Stream stream) const { return values_[static_cast<std::size_t>(stream)]; }
    bool operator==(const PerStream&) const = default;

  private:
    std::array<T, kStreams.size()> values_{};
};

/// Some of the streams.
using StreamChoice = PerStream<bool>;

/// Those of them that come from a device.
StreamChoice fromDevice(const StreamChoice& streams);

constexpr const StreamInfo& infoOf(Stream stream) {
    return kStreams[static_cast<std::size_t>(stream)];
}

/// The streams of a bake.
/// @param asked of those from the device
StreamChoice streamsOf(bool has_terrain, const StreamChoice& asked);

std::size_t countOf(const StreamChoice& streams);

/// What hashes of inputs take of the streams asked for: the same as before there was another than `density`.
std::string identityOf(const StreamChoice& asked);

/// The values of one row.
template <class Value>
std::span<Value, kComponents> rowOf(std::span<Value> values, std::size_t row) {
    return values.subspan(row * kComponents).template first<kComponents>();
}

}  // namespace throng
