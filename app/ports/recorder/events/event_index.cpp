// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_index.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/ports/recorder/folder_change.h"

namespace orbwatch::app::recorder {

Result<bool> EventIndex::update() {
  const auto changed = settled_change(folder_.path());
  const auto is_as_read = [](const StoredEvent& event) {
    return event.changed && event.changed == settled_change(event.folder);
  };
  if (changed && changed == changed_ && std::ranges::all_of(unfinished_, is_as_read)) return false;
  auto listed = folder_.list(events_);
  if (!listed) return tl::unexpected(listed.error());
  changed_ = changed;
  const bool is_other = *listed != events_;
  events_ = std::move(*listed);
  unfinished_.clear();
  std::ranges::copy_if(events_, std::back_inserter(unfinished_),
                       [](const StoredEvent& event) { return !event.is_finished; });
  return is_other;
}

}  // namespace orbwatch::app::recorder
