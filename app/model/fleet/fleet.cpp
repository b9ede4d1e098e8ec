// SPDX-License-Identifier: Apache-2.0
#include "app/model/fleet/fleet.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace orbwatch::app {
namespace {

/// Longer than the interval between two requests of a page.
constexpr std::chrono::seconds kLook{20};

}  // namespace

void Fleet::set_own_id(const std::string& id) {
  const std::lock_guard lock(mutex_);
  self_ = id;
}

Fleet::Place* Fleet::find(const std::string& id) {
  const auto found =
      std::ranges::find(places_, id, [](const Place& place) { return place.entry.id; });
  return found == places_.end() ? nullptr : &*found;
}

void Fleet::receive(const std::string& id, const ApplianceNotice& notice, hal::TimePoint now) {
  const std::lock_guard lock(mutex_);
  Place* place = find(id);
  if (!place) {
    if (!has_room(now)) {
      ++counts_.turned_away;
      return;
    }
    place = &places_.emplace_back();
    place->entry.id = id;
    place->entry.first = now;
  }
  place->entry.notice = notice;
  place->entry.newest = now;
}

/// Removes the entry that has been gone longest if the list is full.
bool Fleet::has_room(hal::TimePoint now) {
  if (places_.size() < kMost) return true;
  sweep(now);
  if (places_.size() < kMost) return true;
  const auto oldest =
      std::ranges::min_element(places_, {}, [](const Place& place) { return place.entry.newest; });
  if (!oldest->entry.is_gone) return false;
  places_.erase(oldest);
  return true;
}

/// Marks silent entries as gone, and removes those that returned under another id.
void Fleet::sweep(hal::TimePoint now) {
  for (Place& place : places_) {
    place.entry.is_gone = now - place.entry.newest > kSilence;
    place.is_over = place.entry.is_gone && is_succeeded(place.entry);
  }
  std::erase_if(places_, [](const Place& place) { return place.is_over; });
}

/// Entries that were active at the same time are different appliances, even under one name.
bool Fleet::is_succeeded(const Entry& gone) {
  const auto next = std::ranges::find_if(places_, [&](const Place& place) {
    return place.entry.notice.name == gone.notice.name && !place.has_predecessor &&
           place.entry.first > gone.newest;
  });
  if (next == places_.end()) return false;
  next->has_predecessor = true;
  return true;
}

void Fleet::show(const std::string& id, std::string jpeg) {
  const std::lock_guard lock(mutex_);
  Place* const place = find(id);
  if (!place || jpeg.size() > kMostPictureBytes) {
    ++counts_.refused;
    return;
  }
  place->picture = std::make_shared<const std::string>(std::move(jpeg));
  ++place->entry.pictures;
}

void Fleet::refuse() {
  const std::lock_guard lock(mutex_);
  ++counts_.refused;
}

std::vector<Fleet::Entry> Fleet::list(hal::TimePoint now) {
  const std::lock_guard lock(mutex_);
  sweep(now);
  std::vector<Entry> entries;
  std::ranges::transform(places_, std::back_inserter(entries), &Place::entry);
  for (Entry& entry : entries) entry.is_self = entry.id == self_;
  std::ranges::sort(entries, {}, [](const Entry& entry) {
    return std::tie(entry.notice.name, entry.first, entry.id);
  });
  return entries;
}

std::shared_ptr<const std::string> Fleet::picture(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::ranges::find(places_, id, [](const Place& place) { return place.entry.id; });
  return found == places_.end() ? nullptr : found->picture;
}

Fleet::Counts Fleet::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

std::size_t Fleet::forget_gone(hal::TimePoint now) {
  const std::lock_guard lock(mutex_);
  sweep(now);
  return std::erase_if(places_, [](const Place& place) { return place.entry.is_gone; });
}

void Fleet::note_viewer(hal::TimePoint now) {
  const std::lock_guard lock(mutex_);
  viewed_at_ = now;
}

bool Fleet::has_viewers(hal::TimePoint now) const {
  const std::lock_guard lock(mutex_);
  return viewed_at_ != hal::TimePoint{} && now - viewed_at_ < kLook;
}

}  // namespace orbwatch::app
