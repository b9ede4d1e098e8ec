// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/live_stream.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/model/status/utc_text.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/views/view_records.h"

namespace orbwatch::app::web {

LiveStream::LiveStream(std::vector<Source> sources, StreamCounts& counts)
    : sources_(std::move(sources)), counts_(counts) {}

void LiveStream::on_data(std::function<void()> wake) {
  readers_.reserve(sources_.size());
  for (const Source& source : sources_) {
    readers_.push_back(std::make_unique<Feed::Reader>(source.feed, wake));
  }
}

void LiveStream::begin(const Source& source, Item item) {
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const bool is_view = !source.name.empty();
  nlohmann::ordered_json head{{"kind", is_view ? "view" : "status"}};
  if (is_view) head["name"] = source.name;
  head["number"] = item.number;
  head["stamp"] = utc_text(hal::to_utc(item.stamp)).value_or("");
  head["age_ms"] = Milliseconds(hal::Clock::now() - item.stamp).count();
  if (item.aim) {
    SentAim aim = sent_aim(*item.aim);
    head["aim"] = json_of(aim);
  }
  if (item.width > 0) {
    head["width"] = item.width;
    head["height"] = item.height;
  }
  head["bytes"] = item.bytes->size();
  head_ = head.dump() + "\n";
  body_ = std::move(item.bytes);
  parts_.begin({head_, *body_, {}});
}

/// Starts the next message, from each source in turn, so that a source that is always ready does
/// not starve others.
bool LiveStream::begin_next() {
  for (std::size_t n = 0; n < sources_.size(); ++n) {
    const std::size_t k = (turn_ + n) % sources_.size();
    Feed::Reader& reader = *readers_[k];
    const std::uint64_t skipped = reader.skipped();
    auto item = reader.next();
    if (!item) continue;
    if (!sources_[k].name.empty()) {
      counts_.skipped += reader.skipped() - skipped;
      ++counts_.sent;
    }
    begin(sources_[k], std::move(*item));
    turn_ = k + 1;
    return true;
  }
  return false;
}

std::size_t LiveStream::read(std::span<char> out) {
  if (parts_.are_sent() && !begin_next()) return 0;
  // The next message is chosen when the client has room for it, so that it is the newest.
  return parts_.read(out);
}

}  // namespace orbwatch::app::web
