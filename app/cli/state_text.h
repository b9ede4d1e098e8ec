// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/cli/dds/received_state.h"

namespace orbwatch::app::cli {

/// Process state as one line of JSON (RFC 8259): the members of the message, then its components in
/// the format of app/model/status/json.h. Bytes that are not UTF-8 become U+FFFD. Reentrant.
std::string state_json(const ReceivedState& state);

/// Process state as text for people. Control characters become question marks. Reentrant.
std::string state_table(const ReceivedState& state);

}  // namespace orbwatch::app::cli
