#include "app/modbus/bits.h"
#include "app/modbus/codes.h"
#include "app/modbus/result_queue.h"
#include "app/modbus/rows/block.h"
#include "app/modbus/rows/rows.h"

namespace orbwatch::app::modbus {
namespace {

using std::chrono::duration_cast;
using std::chrono::milliseconds;
using std::chrono::seconds;
using S = const Snapshot&;

/// What tells about the frame set, by which a PLC knows what belongs together.
void append_frame_set(Block<Snapshot>& block) {
  block
      .u32("frame_set", kCounter,
           "Number of the newest frame set, which the signals belong to; 0: none yet",
           [](S s) { return s.live.status.frame_set; })
      .u32("frame_set_age", kAge,
           "From the frame set's exposure start to this answer: the figure to supervise; stays at "
           "2147483647, also when there is no frame set yet",
           [](S s) {
             return s.live.status.frame_set == 0
                        ? milliseconds::max()
                        : duration_cast<milliseconds>(s.now - s.live.status.stamp);
           })
      .u32("frame_set_utc_seconds", {1, "s", 0, kMaxU32},
           "UTC of the frame set's exposure start, seconds since 1970; 0: none yet",
           [](S s) { return s.live.utc.count() / 1000000; })
      .u32("frame_set_utc_microseconds", {1, "us", 0, 999999}, "Microseconds within that second",
           [](S s) { return s.live.utc.count() % 1000000; })
      .u32("trigger", kCounter,
           "Number of the trigger that began the newest frame set; 0: none did",
           [](S s) { return s.live.status.trigger; })
      .u32("result", kCounter, "Number of the newest result, also of a refused one; 0: none yet",
           [](S s) { return s.live.status.result; })
      .u32("configuration_checksum", kCounter,
           "CRC-32 of all files of the configuration: changes with each change of any of them",
           [](S s) { return s.live.status.configuration_checksum; });
}

void append_counts(Block<Snapshot>& block) {
  block
      .u16("result_count", {1, "", 0, ResultQueue::kDepth}, "Results that wait to be taken",
           [](S s) { return s.results.count; })
      .u16("region_count", {1, "", 0, signals::kMaxRegions}, "Regions that the recipe has",
           [](S s) { return s.live.status.region_count; })
      .u16("camera_count", {1, "", 0, kMaxCameras}, "Cameras that are configured",
           [](S s) { return s.live.status.camera_count; })
      .u16("view_count", {1, "", 0, kMaxViews}, "Views that are configured",
           [](S s) { return s.live.status.view_count; })
      .u32("result_overruns", kCounter, "Results that were refused because the queue was full",
           [](S s) { return s.results.refused; })
      .u32("overruns", kCounter, "Frame sets that took longer than their deadline",
           [](S s) { return s.live.status.overruns; })
      .u32("unmatched", kCounter, "Frame sets in which a camera had no frame within the window",
           [](S s) { return s.live.status.unmatched; })
      .u16("load", {0.1, "%", 0, 6553.5},
           "Share of its deadline that the slowest frame set of the last second took",
           [](S s) { return s.live.status.load * 100; })
      .u16("skew", kLatency,
           "Largest between the exposure starts of a frame set, of the last full second",
           [](S s) { return s.live.status.skew_ms; });
}

void append_server(Block<Snapshot>& block) {
  block
      .u32("plc_heartbeat_age", kAge,
           "Since plc_heartbeat last changed; stays at 2147483647, also when it never has",
           [](S s) { return s.plc.age; })
      .u32("modbus_answered", kCounter, "Requests answered, with or without an exception",
           [](S s) { return s.server.answered; })
      .u32("modbus_refused", kCounter,
           "Requests answered with an exception, or not at all because they were not Modbus",
           [](S s) { return s.server.refused; })
      .u32("modbus_dropped", kCounter,
           "Connections the server ended: too many, too slow, or garbage",
           [](S s) { return s.server.dropped; })
      .u32("uptime", {1, "s", 0, kMaxU32}, "Since the server was started: smaller after a restart",
           [](S s) { return duration_cast<seconds>(s.now - s.start).count(); })
      .u32("serial_broken", kCounter,
           "Frames on the serial line with a wrong checksum or cut off, and noise",
           [](S s) { return s.server.broken; })
      .u32("serial_for_others", kCounter, "Frames on the serial line for or of other units",
           [](S s) { return s.server.for_others; })
      .u16("modbus_connections", kWord, "Connections that are open now",
           [](S s) { return s.server.connections; });
}

}  // namespace

std::vector<Row> system_rows() {
  Block<Snapshot> block(Table::Input, kSystemBlock, "", whole_snapshot);
  block
      .u16("map_version", {1, "", 1, kMaxU16},
           "Version of this map; grows when an existing PLC program could notice a change",
           [](S) { return kMapVersion; })
      .u16("heartbeat", kWord,
           "Advances with the pipeline, at least ten times a second; goes on at 0 after 65535",
           [](S s) { return s.live.status.heartbeat; })
      .u16("system_state", range_of(system_state_codes()), listed(system_state_codes()),
           [](S s) { return s.live.status.state; })
      .u16("status_word", kWord, "Bit n is discrete input n, bit 0 the lowest",
           [](S s) { return word_of(status_bits(), s); })
      .u16("measurement_word", kWord, "Bit n is discrete input 16 + n",
           [](S s) { return word_of(measurement_bits(), s); })
      .u16("fault_word", kWord, "What is wrong now: see the fault bits; 0: nothing",
           [](S s) { return word_of(fault_bits(), s); })
      .u16("recipe", kWord, "Number of the recipe that everything here was measured with",
           [](S s) { return s.live.status.recipe; })
      .u16("selected_view", {1, "", 0, kMaxViews - 1}, "Index of the selected view, from 0",
           [](S s) { return s.live.status.selected_view; });
  append_frame_set(block);
  block.u32("process_inputs", kCounter, "Bit n is discrete input 32 + n",
            [](S s) { return word_of(process_input_bits(), s); });
  append_counts(block);
  append_server(block);
  return block.reserved_to(kHealthBlock).rows();
}

}  // namespace orbwatch::app::modbus
