// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace orbwatch::app::update {

/// Compares versions of images or updates, numbers with dots such as "1.10" as
/// `platform/build-bundle` writes them: part by part as numbers, so that 2.01 is 2.1; a part that
/// is missing is smaller than any. Negative: `a` is older than `b`, 0: the same. Reentrant.
int compare_versions(std::string_view a, std::string_view b);

/// An update, and the device that is to install it.
struct Offer {
  std::string version;             ///< version of the update
  std::string compatible;          ///< kind of devices that the update is for
  std::string installed;           ///< version that runs
  std::string device;              ///< kind of this device
  std::string returned_from = {};  ///< version that this device tried and left, if any
};

/// Reason not to install the update, as a sentence; nullopt: none. Reentrant.
std::optional<std::string> refusal_of(const Offer& offer);

/// Sentence for an operator about RAUC's message on a bundle that it does not accept. Reentrant.
std::string refusal_of_bundle(std::string_view message);

}  // namespace orbwatch::app::update
