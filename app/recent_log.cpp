// SPDX-License-Identifier: Apache-2.0
#include "app/recent_log.h"

#include <algorithm>
#include <utility>

namespace orbwatch::app {

void RecentLog::add(const LogRecord& record) {
  Line line{0,
            std::chrono::system_clock::now(),
            record.level,
            std::string(record.text.substr(0, kMostText)),
            std::string(record.fields.camera),
            std::string(record.fields.fault),
            record.fields.trigger};
  const std::lock_guard lock(mutex_);
  line.number = ++number_;
  lines_.push_back(std::move(line));
  if (lines_.size() > kMostLines) lines_.pop_front();
}

std::uint64_t RecentLog::newest_number() const {
  const std::lock_guard lock(mutex_);
  return number_;
}

std::vector<RecentLog::Line> RecentLog::newest(const Wanted& wanted) const {
  std::vector<Line> found;
  const std::lock_guard lock(mutex_);
  for (auto line = lines_.rbegin(); line != lines_.rend(); ++line) {
    if (line->number <= wanted.after || found.size() == wanted.most) break;
    if (line->level <= wanted.least) found.push_back(*line);
  }
  std::ranges::reverse(found);
  return found;
}

}  // namespace orbwatch::app
