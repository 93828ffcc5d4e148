// SPDX-License-Identifier: Apache-2.0
#include "authoring/source_position.h"

#include <fmt/format.h>

#include "authoring/layout/json_document.h"

namespace throng::authoring {

SourcePath SourcePath::member(const std::string& key) const {
    SourcePath inner;
    inner.last_ = std::make_shared<const Step>(Step{opened().last_, appendPointer({}, key)});
    return inner;
}

SourcePath SourcePath::item(std::size_t index) const {
    SourcePath inner = opened();
    inner.index_ = index;
    return inner;
}

SourcePath SourcePath::opened() const {
    if (index_ == kNoIndex) return *this;
    SourcePath whole;
    whole.last_ = std::make_shared<const Step>(Step{last_, fmt::format("/{}", index_)});
    return whole;
}

std::string SourcePath::text() const {
    std::string text = index_ == kNoIndex ? "" : fmt::format("/{}", index_);
    for (const Step* step = last_.get(); step; step = step->before.get())
        text.insert(0, step->words);
    return text;
}

}  // namespace throng::authoring
