// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

/// The forms in which a bake's streams lie on the disk, each told once. What writes, reads, checks and asks
/// for them follows kStreamFormats; nothing else lists them.
namespace throng {

/// In the order of kStreamFormats, which is that in which readers prefer them.
enum class StreamFormat { npy, pc2, packed };

/// One row of the table.
struct StreamFormatInfo {
    StreamFormat id;
    std::string_view name;   ///< of its files, its member in bake.json and the option that asks for it
    std::string_view about;  ///< in words
    double bytes;            ///< that a person takes in a frame of one stream, about
    bool is_default;         ///< written unless told
    bool is_exact;           ///< holds what was recorded to the last bit
};

inline constexpr std::array kStreamFormats = {
    StreamFormatInfo{StreamFormat::npy, "npy", "NumPy arrays", 12.0, true, true},
    StreamFormatInfo{StreamFormat::pc2, "pc2", "point caches, which Blender plays", 12.0, true, true},
    StreamFormatInfo{StreamFormat::packed, "packed", "compressed, coordinates to within 0.04 mm", 1.0, false,
                     false},
};

constexpr const StreamFormatInfo& infoOf(StreamFormat format) {
    return kStreamFormats[static_cast<std::size_t>(format)];
}

/// Some of the forms.
class StreamFormats {
  public:
    /// Those that are written unless told.
    static constexpr StreamFormats standard() {
        StreamFormats formats;
        for (const StreamFormatInfo& info : kStreamFormats)
            formats.has_[static_cast<std::size_t>(info.id)] = info.is_default;
        return formats;
    }
    constexpr bool has(StreamFormat format) const { return has_[static_cast<std::size_t>(format)]; }
    constexpr void add(StreamFormat format) { has_[static_cast<std::size_t>(format)] = true; }
    constexpr bool isEmpty() const { return *this == StreamFormats(); }
    /// The one that readers take. There has to be one.
    StreamFormat preferred() const;
    /// Bytes that a person takes in a frame of one stream, about.
    double bytes() const;
    bool operator==(const StreamFormats&) const = default;

  private:
    std::array<bool, kStreamFormats.size()> has_{};
};

/// "npy,pc2"
std::string wordsOf(const StreamFormats& formats);
/// All that there are, for help: "npy (NumPy arrays), ..."
std::string formatsInWords();

/// What came of reading a list of their names.
struct FormatsRead {
    StreamFormats formats;
    std::string problem;  ///< in words; empty: none
};
/// @param words names with commas between them, at least one
FormatsRead readFormats(std::string_view words);

}  // namespace throng
