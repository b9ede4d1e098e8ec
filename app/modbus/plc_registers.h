#pragma once

#include <cstdint>

#include "app/modbus/command_registers.h"

namespace orbwatch::app::modbus {

/// What PLCs write.
struct PlcRegisters {
  CommandRegisters command;
  std::uint16_t heartbeat = 0;
  /// Number of the result that the present request takes; 0: none.
  std::uint32_t result_taken = 0;
};

}  // namespace orbwatch::app::modbus
