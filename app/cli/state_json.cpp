#include "app/cli/state_fields.h"
#include "app/cli/state_text.h"
#include "app/json/json_object.h"

namespace orbwatch::app {

std::string state_json(const ReceivedState& state) {
  return json_document(state, JsonLayout::OneLine) + "\n";
}

}  // namespace orbwatch::app
