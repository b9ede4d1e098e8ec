#pragma once

#include <string>

#include "hal/inventory.h"

namespace orbwatch::app {

/// What is connected now, by every back-end that can tell. Disturbs no camera that streams.
hal::Inventory take_inventory();

/// An inventory as one JSON document (RFC 8259), whatever its texts hold: what is not UTF-8 becomes
/// U+FFFD.
std::string list_json(const hal::Inventory& inventory);

/// An inventory as text for people. What a terminal would obey becomes a question mark.
std::string list_table(const hal::Inventory& inventory);

}  // namespace orbwatch::app
