#include <algorithm>

#include "app/modbus/rows/block.h"
#include "app/modbus/rows/rows.h"

namespace orbwatch::app::modbus {

static_assert(kHealthBlock + 2 * kHealthFigures.size() <= kMaxReadRegisters,
              "one request reads system and health");
static_assert(std::ranges::all_of(kHealthFigures, fits<HealthInfo>));

std::vector<Row> health_rows() {
  Block<Health> block(Table::Input, kHealthBlock, "",
                      [](const Snapshot& s) -> const Health& { return s.live.status.health; });
  for (const HealthInfo& figure : kHealthFigures) {
    block.i32(std::string(figure.name), quantity_of(figure), std::string(figure.description),
              figure.member);
  }
  return block.reserved_to(kCameraBlock).rows();
}

}  // namespace orbwatch::app::modbus
