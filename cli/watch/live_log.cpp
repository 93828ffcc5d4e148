// SPDX-License-Identifier: Apache-2.0
#include "cli/watch/live_log.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace throng::cli {
namespace {

using Json = nlohmann::ordered_json;

LiveLog::Message messageOf(std::string_view kind, std::string_view content) {
    auto message = std::make_shared<std::string>(kind);
    for (int shift = 0; shift < 32; shift += 8)
        *message += static_cast<char>(content.size() >> shift & 255u);
    *message += content;
    return message;
}

std::string textOf(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

void LiveLog::begin(const Json& crowd) {
    Message message = messageOf("CROW", textOf(crowd));
    const std::lock_guard lock(mutex_);
    ++crowd_;
    bytes_ = 0;
    messages_ = {std::move(message)};
    changed_.notify_all();
}

bool LiveLog::add(const std::string& moment) {
    Message message = messageOf("MOMT", moment);
    const std::lock_guard lock(mutex_);
    if (bytes_ + message->size() > most_bytes_) return false;
    bytes_ += message->size();
    messages_.push_back(std::move(message));
    changed_.notify_all();
    return true;
}

void LiveLog::note(Json members) {
    const std::lock_guard lock(mutex_);
    noted_ = std::move(members);
}

void LiveLog::tell(Json how_it_goes) {
    const std::lock_guard lock(mutex_);
    if (noted_.is_object()) how_it_goes.update(noted_);
    Message message = messageOf("TELL", textOf(how_it_goes));
    ++told_;
    last_told_ = std::move(message);
    changed_.notify_all();
}

void LiveLog::close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
}

bool LiveLog::hasNews(const Place& place) const {
    return closed_ || place.told != told_ || place.crowd != crowd_ || place.next < messages_.size();
}

LiveLog::News LiveLog::read(Place& place, std::chrono::milliseconds patience) const {
    constexpr std::size_t kMostBytes = std::size_t{1}
                                       << 20;  // at once: a new crowd need not wait for an old one
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [&] { return hasNews(place); });
    News news;
    news.closed = closed_;
    if (place.crowd != crowd_) place = {crowd_, place.told, 0};
    for (std::size_t bytes = 0; place.next < messages_.size() && bytes < kMostBytes; ++place.next) {
        news.messages.push_back(messages_[place.next]);
        bytes += messages_[place.next]->size();
    }
    // Who hears that there is no more has all of it.
    if (place.told != told_ && place.next == messages_.size()) {
        news.messages.push_back(last_told_);
        place.told = told_;
    }
    return news;
}

}  // namespace throng::cli
