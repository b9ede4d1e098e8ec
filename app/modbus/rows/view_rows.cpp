#include "app/modbus/rows/block.h"
#include "app/modbus/rows/rows.h"

namespace orbwatch::app::modbus {
namespace {

static_assert(kViewBlock + int{kMaxViews} * kViewStride <= kAlarmBlock);

std::vector<Row> rows_of_view(std::size_t index) {
  const int base = kViewBlock + static_cast<int>(index) * kViewStride;
  Block<ViewStatus> block(
      Table::Input, base, "view_" + std::to_string(index) + "_",
      [index](const Snapshot& s) -> const ViewStatus& { return s.live.status.views[index]; });
  block.u32("published", kCounter, "Views published since start", &ViewStatus::published)
      .u32("skipped", kCounter, "Frame sets without this view: display slowed down, or no buffer",
           &ViewStatus::skipped)
      .u32("superseded", kCounter,
           "Requests to point it that a newer one replaced before the next frame set",
           &ViewStatus::superseded)
      .u16("frames_per_second", kRate, "Over the last full second", &ViewStatus::frames_per_second)
      .u16("latency_p50", kLatency, "Exposure start to hand-over, median of the last full second",
           &ViewStatus::latency_p50_ms)
      .u16("latency_p99", kLatency, "Exposure start to hand-over, 99 of 100 are faster",
           &ViewStatus::latency_p99_ms);
  return block.reserved_to(base + kViewStride).rows();
}

}  // namespace

std::vector<Row> view_rows() { return joined(kMaxViews, rows_of_view); }

}  // namespace orbwatch::app::modbus
