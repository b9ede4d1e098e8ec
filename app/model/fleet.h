#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/model/appliance_notice.h"
#include "hal/clock.h"

namespace orbwatch::app {

/// The appliances of a site, as they are heard of: bounded, whatever is heard. Those that fall
/// silent stay as gone, until they are back or forgotten. One that is started again has another id:
/// it takes the place of one with its name that was silent before. Thread-safe.
class Fleet {
 public:
  static constexpr std::size_t kMost = 256;
  /// Without word for longer it is gone.
  static constexpr std::chrono::seconds kSilence{5};
  static constexpr std::size_t kMostPictureBytes = 16384;

  struct Entry {
    std::string id;  ///< one run of one appliance
    ApplianceNotice notice;
    hal::TimePoint first, newest;  ///< when it was heard
    bool is_gone = false;
    bool is_self = false;
    std::uint64_t pictures = 0;  ///< received; 0: there is none to show
  };

  /// What is not in the list, since the start.
  struct Counts {
    std::uint64_t turned_away = 0;  ///< notices of those for which there was no place
    std::uint64_t refused = 0;      ///< notices and pictures that were wrong
  };

  /// Which id is the own one.
  void call_self(const std::string& id);

  void hear(const std::string& id, const ApplianceNotice& notice, hal::TimePoint now);
  /// Keeps the newest picture of one that was heard; others and what is too large are refused.
  void show(const std::string& id, std::string jpeg);
  void refuse();

  /// By name, those of the same name in the order in which they came.
  std::vector<Entry> list(hal::TimePoint now);
  /// Null: there is none.
  std::shared_ptr<const std::string> picture(const std::string& id) const;
  Counts counts() const;

  /// Those that are gone. Returns how many.
  std::size_t forget_gone(hal::TimePoint now);

  /// Somebody looks at the pictures: they are fetched for a while.
  void look(hal::TimePoint now);
  bool is_looked_at(hal::TimePoint now) const;

 private:
  struct Place {
    Entry entry;
    bool has_predecessor = false;  ///< it took the place of another
    bool is_over = false;          ///< another took its place
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
  hal::TimePoint looked_at_;
};

}  // namespace orbwatch::app
