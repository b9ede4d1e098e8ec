// SPDX-License-Identifier: Apache-2.0
#include "app/update/refusal.h"

#include <cstring>

namespace orbwatch::app::update {

int compare_versions(const std::string& a, const std::string& b) {
  return ::strverscmp(a.c_str(), b.c_str());
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
