// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/model/fleet/fleet.h"
#include "hal/inventory.h"

namespace orbwatch::app::cli {

/// An inventory as one JSON document (RFC 8259). Bytes that are not UTF-8 become U+FFFD.
std::string list_json(const hal::Inventory& inventory);

/// An inventory as text for people. Control characters become question marks.
std::string list_table(const hal::Inventory& inventory);

/// Appliances as one JSON document, and as a table. Reentrant.
std::string appliances_json(const std::vector<Fleet::Entry>& appliances, hal::TimePoint now);
std::string appliances_table(const std::vector<Fleet::Entry>& appliances);

}  // namespace orbwatch::app::cli
