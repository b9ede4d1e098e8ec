#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace orbwatch::app {

/// What the places in the lists of a Status are called.
struct StatusNames {
  std::vector<std::string> cameras;
  std::vector<std::string> views;
  std::map<std::uint16_t, std::vector<std::string>> regions;  ///< by the number of their recipe

  /// Empty when the region has no name.
  std::string_view region(std::uint16_t recipe, std::size_t index) const {
    const auto found = regions.find(recipe);
    if (found == regions.end() || index >= found->second.size()) return {};
    return found->second[index];
  }
};

}  // namespace orbwatch::app
