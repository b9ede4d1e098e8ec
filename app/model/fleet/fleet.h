// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/model/fleet/appliance_notice.h"
#include "hal/clock.h"

namespace orbwatch::app {

/// List of the site's appliances that announce themselves, of bounded size. Appliances that fall
/// silent stay in the list as gone, until they return or are removed. A restarted appliance has
/// another id: it replaces an entry of its name that was silent before. Thread-safe.
class Fleet {
 public:
  static constexpr std::size_t kMost = 256;
  /// Silence after which an appliance counts as gone.
  static constexpr std::chrono::seconds kSilence{5};
  static constexpr std::size_t kMostPictureBytes = 16384;

  struct Entry {
    std::string id;  ///< unique for one run of one appliance
    ApplianceNotice notice;
    hal::TimePoint first, newest;  ///< times of its first and newest notice
    bool is_gone = false;
    bool is_self = false;
    std::uint64_t pictures = 0;  ///< pictures received; 0: there is none
  };

  /// Counts of rejected messages since the start.
  struct Counts {
    std::uint64_t turned_away = 0;  ///< notices of appliances beyond kMost
    std::uint64_t refused = 0;      ///< invalid notices and pictures
  };

  /// Sets the id of this appliance.
  void set_own_id(const std::string& id);

  void receive(const std::string& id, const ApplianceNotice& notice, hal::TimePoint now);
  /// Keeps the newest picture of a listed appliance. Refused: pictures of unknown appliances, and
  /// those above kMostPictureBytes.
  void show(const std::string& id, std::string jpeg);
  void refuse();

  /// Entries by name; those of the same name in order of arrival.
  std::vector<Entry> list(hal::TimePoint now);
  /// The newest picture of an appliance; null: none.
  std::shared_ptr<const std::string> picture(const std::string& id) const;
  Counts counts() const;

  /// Removes the entries that are gone. Returns their number.
  std::size_t forget_gone(hal::TimePoint now);

  /// Reports a viewer of the pictures: they are received for a while.
  void note_viewer(hal::TimePoint now);
  bool has_viewers(hal::TimePoint now) const;

 private:
  struct Place {
    Entry entry;
    bool has_predecessor = false;  ///< it replaced another entry
    bool is_over = false;          ///< another entry replaced it
    std::shared_ptr<const std::string> picture;
  };

  Place* find(const std::string& id);
  bool has_room(hal::TimePoint now);
  void sweep(hal::TimePoint now);
  bool is_succeeded(const Entry& gone);

  mutable std::mutex mutex_;
  std::vector<Place> places_;  // all under the mutex
  std::string self_;
  Counts counts_;
  hal::TimePoint viewed_at_;
};

}  // namespace orbwatch::app
