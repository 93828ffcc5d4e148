// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

namespace throng::authoring {

/// The way to a value of a document. Values beside each other share the way to what they are in: documents
/// hold as much of it as they are long, however deep their values lie.
class SourcePath {
  public:
    SourcePath() = default;
    /// A way that is known in words.
    explicit SourcePath(std::string words)
        : last_(std::make_shared<const Step>(Step{{}, std::move(words)})) {}

    SourcePath member(const std::string& key) const;
    SourcePath item(std::size_t index) const;
    /// The same for a value with others inside, which share what this makes.
    SourcePath opened() const;

    bool empty() const { return !last_ && index_ == kNoIndex; }
    /// A JSON pointer (RFC 6901), e.g. "/roads/0/width".
    std::string text() const;

  private:
    static constexpr std::size_t kNoIndex = ~std::size_t{0};
    struct Step {
        std::shared_ptr<const Step> before;
        std::string words;  ///< what comes after it, "/width", or the whole way
    };
    std::shared_ptr<const Step> last_;  ///< null: the document
    std::size_t index_ = kNoIndex;      ///< of an item, which has no step of its own unless it was opened
};

/// Where a value stands in its file, so that errors found long after parsing still point at it.
struct SourcePosition {
    int line = 0;     ///< from 1; 0 when the value was not written in the file
    int column = 0;   ///< from 1
    SourcePath path;  ///< to the value

    std::string pointer() const { return path.text(); }
};

}  // namespace throng::authoring
