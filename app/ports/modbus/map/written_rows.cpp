// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/map/block.h"
#include "app/ports/modbus/map/rows.h"

namespace orbwatch::app::modbus {
namespace {

/// 0 and the commands of the model.
std::vector<CodeText> command_codes() {
  std::vector<CodeText> codes{{0, "none"}};
  for (const CommandInfo& command : kCommands) {
    codes.push_back({static_cast<std::uint16_t>(command.code), command.name});
  }
  return codes;
}

/// Writes a 16-bit member of the command registers.
template <std::uint16_t CommandRegisters::*member>
void write_command(PlcRegisters& plc, std::uint32_t value) {
  plc.command.*member = static_cast<std::uint16_t>(value);
}

}  // namespace

/// Writable registers are contiguous, so that a PLC may write them in one cyclic request, the
/// sequence last: a PLC that writes register by register in ascending order starts the command with
/// the last one.
void add_written_rows(std::vector<Row>& rows) {
  using P = const PlcRegisters&;
  using I = const ProcessImage&;
  const std::vector<CodeText> commands = command_codes();
  const Quantity any_command{"", 1, 0, static_cast<double>(commands.back().number)};
  Block<PlcRegisters> block(
      rows, Table::Holding, kWritten, "", [](I image) -> auto& { return image.written; });
  for (std::size_t i = 0; i < kMaxArguments; ++i) {
    const std::string n = std::to_string(i);
    block
        .row(Type::Dint, "argument_" + n, {"", 1, -2147483648.0, 2147483647},
             "Argument " + n + " of the command: its value / its scale, see the commands",
             [i](P plc, I) { return plc.command.arguments[i]; })
        .written([i](PlcRegisters& plc, std::uint32_t value) {
          plc.command.arguments[i] = static_cast<std::int32_t>(value);
        });
  }
  block
      .row(Type::Udint, "result_acknowledged", kDoubleWord,
           "Number of a result to acknowledge: if it equals that of the result in the window, the "
           "result is removed and the next one appears; another number has no effect. Reads the "
           "number acknowledged last; 0: none yet",
           [](P, I image) { return image.last_acknowledged; })
      .written([](PlcRegisters& plc, std::uint32_t value) { plc.result_acknowledged = value; })
      .row(Type::Uint, "plc_heartbeat", kWord, "Heartbeat of the PLC, to be changed periodically",
           [](P plc, I) { return plc.heartbeat; })
      .written([](PlcRegisters& plc, std::uint32_t value) {
        plc.heartbeat = static_cast<std::uint16_t>(value);
      })
      .row(Type::Uint, "command", any_command, listed(commands),
           [](P plc, I) { return plc.command.command; })
      .written(write_command<&CommandRegisters::command>)
      .row(Type::Uint, "command_sequence", kWord,
           "A value other than acknowledged_sequence executes the command, at most once, also "
           "across restarts",
           [](P plc, I) { return plc.command.sequence; })
      .written(write_command<&CommandRegisters::sequence>)
      .row(Type::Uint, "acknowledged_sequence", kWord,
           "command_sequence of the last answered command",
           [](P plc, I) { return plc.command.acknowledged; })
      .row(Type::Uint, "command_result", code_range<CommandResult>(),
           "Result of that command: " + listed_codes<CommandResult>(),
           [](P plc, I) { return static_cast<int>(plc.command.result); })
      .row(Type::Uint, "last_command", any_command, "Code of that command; 0: none yet",
           [](P plc, I) { return plc.command.last_command; });
}

void add_machine_state_rows(std::vector<Row>& rows) {
  using P = const PlcRegisters&;
  using I = const ProcessImage&;
  using Plc = PlcRegisters;
  using Value = std::uint32_t;
  Block<PlcRegisters> block(
      rows, Table::Holding, kMachineState, "state_",
      [](I image) -> auto& { return image.written; });
  for (std::size_t i = 0; i < MachineRegisters().part.size(); ++i) {
    block
        .row(Type::Uint, "part_" + std::to_string(i), kWord,
             part_words_text("Name of the part", static_cast<int>(i)),
             [i](P plc, I) { return plc.machine.part[i]; })
        .written([i](Plc& plc, Value value) {
          plc.machine.part[i] = static_cast<std::uint16_t>(value);
        });
  }
  block
      .row(Type::Udint, "clock_seconds", kDoubleWord,
           "The controller's clock at the moment of the state, whole seconds since any moment; "
           "4294967295: it sends none, the state's moment is its arrival less delay_ms",
           [](P plc, I) { return plc.machine.clock_seconds; })
      .written([](Plc& plc, Value value) { plc.machine.clock_seconds = value; })
      .row(Type::Udint, "clock_microseconds", {"us", 1, 0, 999999}, "Microseconds of that second",
           [](P plc, I) { return plc.machine.clock_microseconds; })
      .written([](Plc& plc, Value value) { plc.machine.clock_microseconds = value; })
      .row(Type::Udint, "sequence", kDoubleWord,
           "Number of the state: a write that repeats the number before is ignored",
           [](P plc, I) { return plc.machine.sequence; })
      .written([](Plc& plc, Value value) { plc.machine.sequence = value; });
  for (std::size_t i = 0; i < kMachineValues.size(); ++i) {
    const MachineValue& value = kMachineValues[i];
    block
        .row(Type::Dint, value.name, value,
             std::string(value.description) + "; -2147483648: not known",
             [i](P plc, I) { return plc.machine.values[i]; })
        .written([i](Plc& plc, Value written) {
          plc.machine.values[i] = static_cast<std::int32_t>(written);
        });
  }
  assert(rows.back().address + rows.back().count >= kWholeMachineState.end);
}

}  // namespace orbwatch::app::modbus
