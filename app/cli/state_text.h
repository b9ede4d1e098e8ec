#pragma once

#include <string>

#include "app/dds/process_state.h"

namespace orbwatch::app {

/// A process state as one line of JSON (RFC 8259): every signal and health figure by its name, in
/// the unit of its list, null where it is not valid; of an enumeration the number and, as
/// <name>_text, its meaning. Reentrant.
std::string state_json(const ReceivedState& state);

/// A process state as text for people. What a terminal would obey becomes a question mark.
/// Reentrant.
std::string state_table(const ReceivedState& state);

}  // namespace orbwatch::app
