// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "app/model/machine/machine_state.h"
#include "app/ports/web/api/route.h"

namespace orbwatch::app::web {

/// Takes states of the machine from scripts, on the server's threads. They are not recorded in the
/// audit: a machine sends many a second. Thread-safe.
class MachineDesk {
 public:
  explicit MachineDesk(MachinePath path) : path_(std::move(path)) {}

  Response take(const Request& request) const;

 private:
  const MachinePath path_;
};

/// Route of a state, whose values are the members of its body. `desk` outlives it; null: the route
/// is only described.
Route machine_state_route(const MachineDesk* desk);

}  // namespace orbwatch::app::web
