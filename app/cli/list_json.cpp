#include "app/cli/list.h"
#include "app/cli/list_fields.h"
#include "app/json/json_object.h"

namespace orbwatch::app {

std::string list_json(const hal::Inventory& inventory) {
  return json_document(inventory, JsonLayout::EntryPerLine) + "\n";
}

}  // namespace orbwatch::app
