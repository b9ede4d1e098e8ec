// SPDX-License-Identifier: Apache-2.0
#include "app/update/refusal.h"

#include <algorithm>

namespace orbwatch::app::update {
namespace {

/// Takes the part up to the next dot off, without its leading zeros.
std::string_view take_part(std::string_view& version) {
  std::string_view part = version.substr(0, version.find('.'));
  version.remove_prefix(std::min(part.size() + 1, version.size()));
  part.remove_prefix(std::min(part.find_first_not_of('0'), part.size()));
  return part;
}

}  // namespace

int compare_versions(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    const std::string_view one = take_part(a), other = take_part(b);
    if (one.size() != other.size()) return one.size() < other.size() ? -1 : 1;
    if (const int order = one.compare(other); order != 0) return order;
  }
  return static_cast<int>(b.empty()) - static_cast<int>(a.empty());
}

std::optional<std::string> refusal_of(const Offer& offer) {
  if (offer.compatible != offer.device) {
    return "it is for devices of kind " + offer.compatible + ", and this one is " + offer.device;
  }
  const int order = compare_versions(offer.version, offer.installed);
  if (order == 0) return "its version, " + offer.version + ", runs already";
  if (order < 0) {
    return "its version, " + offer.version + ", is older than the running one, " + offer.installed;
  }
  if (offer.version == offer.returned_from) {
    return "this device has tried version " + offer.version + " and returned from it";
  }
  return std::nullopt;
}

std::string refusal_of_bundle(std::string_view message) {
  const bool is_signature =
      message.find("signature verification failed") != std::string_view::npos ||
      message.find("Verify error") != std::string_view::npos;
  return std::string(is_signature ? "it is not signed by the key of this device"
                                  : "it is incomplete or not an update") +
         " (RAUC: " + std::string(message) + ")";
}

}  // namespace orbwatch::app::update
