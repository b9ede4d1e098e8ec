// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "proc/align/advise/advice.h"

namespace orbwatch::app::cli {

/// Text for people, with the changes to make.
std::string advise_text(const align::Arrangement& arrangement, const align::Advice& advice);

/// One JSON object (RFC 8259) with the members of align::Advice under their names.
std::string advise_json(const align::Advice& advice);

}  // namespace orbwatch::app::cli
