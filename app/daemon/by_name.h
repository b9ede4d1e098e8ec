#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace orbwatch::app {

/// The place of a name that is among them, as the configuration's checks saw to.
template <class Named>
std::size_t index_of(const std::vector<Named>& list, const std::string& name) {
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const Named& item) { return item.name == name; });
  return static_cast<std::size_t>(it - list.begin());
}

template <class Named>
const Named& by_name(const std::vector<Named>& list, const std::string& name) {
  return list[index_of(list, name)];
}

}  // namespace orbwatch::app
