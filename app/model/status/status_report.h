// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/status/status.h"

namespace orbwatch::app {

/// The names of the entries in the lists of a Status.
struct StatusNames {
  std::vector<std::string> cameras;
  std::vector<std::string> views;
  std::map<std::uint16_t, std::vector<std::string>> regions;  ///< names by number of the recipe
  std::vector<std::string> process_inputs = {};

  /// Empty when the region has no name.
  std::string_view region(std::uint16_t recipe, std::size_t index) const {
    const auto found = regions.find(recipe);
    return found == regions.end() ? std::string_view{} : name_at(found->second, index);
  }
  std::string_view camera(std::size_t index) const { return name_at(cameras, index); }
  std::string_view view(std::size_t index) const { return name_at(views, index); }

 private:
  static std::string_view name_at(const std::vector<std::string>& names, std::size_t index) {
    return index < names.size() ? std::string_view(names[index]) : std::string_view{};
  }
};

/// A status with everything that an interface needs to report it.
struct StatusReport {
  const Status& status;
  const StatusNames& names;
  hal::TimePoint now;                           ///< reference time of ages
  std::chrono::system_clock::time_point stamp;  ///< UTC of Status::stamp; the epoch: none yet
};

}  // namespace orbwatch::app
