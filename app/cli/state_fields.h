#pragma once

#include "app/dds/process_state.h"
#include "app/json/status_fields.h"

namespace orbwatch::app {

/// What `orbwatch state` shows, for the visitors of status_fields.h.
template <class Visitor>
void visit(Visitor& v, const ReceivedState& state) {
  visit(v, state.report);
  v.object("commands", [&state](auto& commands) { visit(commands, state.commands); });
}

}  // namespace orbwatch::app
