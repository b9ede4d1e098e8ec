#include "app/modbus/codes.h"
#include "app/modbus/rows/block.h"
#include "app/modbus/rows/rows.h"

namespace orbwatch::app::modbus {

/// All that is written stands side by side, so that a PLC may write it in one cyclic request; the
/// sequence stands last: one that writes register by register in ascending order starts the command
/// with the last one.
std::vector<Row> written_rows() {
  using P = PlcRegisters&;
  using Value = std::uint32_t;
  Block<PlcState> block(Table::Holding, 0, "",
                        [](const Snapshot& s) -> const PlcState& { return s.plc; });
  for (std::size_t i = 0; i < kMaxArguments; ++i) {
    const std::string n = std::to_string(i);
    block
        .i32("argument_" + n, {1, "", -kMaxI32 - 1, kMaxI32},
             "Argument " + n + " of the command: its value / its scale, see the commands",
             [i](const PlcState& plc) { return plc.command.arguments[i]; })
        .written([i](P plc, Value value) {
          plc.command.arguments[i] = static_cast<std::int32_t>(value);
        });
  }
  block
      .u32("result_taken", kCounter,
           "Writing the number of the result in the window takes it, and the next one appears; "
           "another number does nothing. Reads the number taken last; 0: none yet",
           [](const PlcState&, const Snapshot& s) { return s.results.last_taken; })
      .written([](P plc, Value value) { plc.result_taken = value; })
      .u16("plc_heartbeat", kWord, "To be changed again and again: the PLC lives",
           &PlcState::heartbeat)
      .written([](P plc, Value value) { plc.heartbeat = static_cast<std::uint16_t>(value); })
      .u16("command", range_of(command_codes()), listed(command_codes()),
           [](const PlcState& plc) { return plc.command.command; })
      .written([](P plc, Value value) { plc.command.command = static_cast<std::uint16_t>(value); })
      .u16("command_sequence", kWord,
           "Another value than acknowledged_sequence carries the command out, once",
           [](const PlcState& plc) { return plc.command.sequence; })
      .written([](P plc, Value value) { plc.command.sequence = static_cast<std::uint16_t>(value); })
      .u16("acknowledged_sequence", kWord, "command_sequence of the last command that was answered",
           [](const PlcState& plc) { return plc.command.acknowledged; })
      .u16("command_result", range_of(command_result_codes()),
           "Result of that command: " + listed(command_result_codes()),
           [](const PlcState& plc) { return plc.command.result; })
      .u16("last_command", range_of(command_codes()), "Code of that command; 0: none yet",
           [](const PlcState& plc) { return plc.command.last_command; });
  return block.rows();
}

}  // namespace orbwatch::app::modbus
