// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <type_traits>

#include "app/model/command/command.h"
#include "app/model/machine/machine_values.h"
#include "app/model/machine/part_name.h"
#include "app/model/status/status.h"

/// Data from which one request is answered: the model's status, and the parts that this interface
/// adds to it, described by lines of the same form (app/model/status/field.h).
namespace orbwatch::app::modbus {

/// Limit of results that wait for the PLC.
inline constexpr std::size_t kResultQueueDepth = 8;

inline constexpr Quantity kWaitingResults{"", 1, 0, kResultQueueDepth};
inline constexpr Quantity kUptime{"s", 1, 0, 4294967295};

#define ORBWATCH_MODBUS_RESULT_FIGURES(FIELD)                                                 \
  FIELD(std::uint16_t, count, kWaitingResults, "Results that wait for their acknowledgement") \
  FIELD(bool, overrun, kFlag,                                                                 \
        "A result was refused because the queue was full; set until all waiting results are " \
        "acknowledged")                                                                       \
  FIELD(std::uint64_t, overruns, kCount, "Results refused because the queue was full")

/// The queue of results.
struct ResultQueueStatus {
  ORBWATCH_MODBUS_RESULT_FIGURES(ORBWATCH_FIELD_MEMBER)
};

#define ORBWATCH_MODBUS_PLC_FIGURES(FIELD, AGE)                                        \
  FIELD(bool, alive, kFlag, "plc_heartbeat is supervised and changed in time")         \
  FIELD(bool, silent, kFlag, "plc_heartbeat is supervised and did not change in time") \
  AGE(heartbeat, "Since plc_heartbeat changed")

/// State of the PLC, judged by its heartbeat.
struct PlcStatus {
  ORBWATCH_MODBUS_PLC_FIGURES(ORBWATCH_FIELD_MEMBER, ORBWATCH_AGE_MEMBER)
};

#define ORBWATCH_MODBUS_COUNTERS(FIELD)                                                        \
  FIELD(std::uint64_t, answered, kCount, "Requests answered, with or without an exception")    \
  FIELD(std::uint64_t, refused, kCount,                                                        \
        "Requests answered with an exception, or dropped because they were not Modbus")        \
  FIELD(std::uint64_t, dropped, kCount,                                                        \
        "Connections closed by the server: too many, too slow, or not Modbus")                 \
  FIELD(std::uint64_t, connections, kCount, "Open connections")                                \
  FIELD(std::uint64_t, serial_errors, kCount,                                                  \
        "Invalid frames on the serial line: wrong checksum, truncated, or noise")              \
  FIELD(std::uint64_t, serial_other_units, kCount, "Frames of other units on the serial line") \
  FIELD(std::uint64_t, serial_echoes, kCount,                                                  \
        "Own answers on the serial line that the adapter echoed; they are dropped")

#define ORBWATCH_MODBUS_SERVER_FIGURES(FIELD)                                                     \
  FIELD(std::uint64_t, uptime, kUptime, "Time since the server started; smaller after a restart") \
  ORBWATCH_MODBUS_COUNTERS(FIELD)

/// Counters of the server since its start.
struct ServerStatus {
  ORBWATCH_MODBUS_SERVER_FIGURES(ORBWATCH_FIELD_MEMBER)
};

/// The counters of a ServerStatus; written by the serving threads, read by any.
struct ServerCounters {
#define ORBWATCH_COUNTER(type, name, ...) std::atomic<type> name{0};
  ORBWATCH_MODBUS_COUNTERS(ORBWATCH_COUNTER)
#undef ORBWATCH_COUNTER

  ServerStatus read() const {
    ServerStatus status;
#define ORBWATCH_READ(type, name, ...) status.name = name;
    ORBWATCH_MODBUS_COUNTERS(ORBWATCH_READ)
#undef ORBWATCH_READ
    return status;
  }
};

/// The command handshake: the PLC writes arguments and command, then another sequence; the command
/// is executed at most once, and then its sequence is returned as acknowledged. Counters, not
/// toggle bits: two toggles between two reads cancel each other.
struct CommandRegisters {
  std::array<std::int32_t, kMaxArguments> arguments{};  ///< value / the argument's scale
  std::uint16_t command = 0;
  std::uint16_t sequence = 0;
  std::uint16_t acknowledged = 0;
  CommandResult result = CommandResult::Done;  ///< result of the command acknowledged last
  std::uint16_t last_command = 0;  ///< code of the command acknowledged last; 0: none yet
};

/// Content of a DINT without a value.
inline constexpr std::uint32_t kNotValidCode = 0x80000000;

/// Registers of a part's name, two bytes of UTF-8 each, zero-padded.
inline constexpr int kPartWords = PartName::kMost / 2;

/// State of the machine in registers, as a PLC writes it.
struct MachineRegisters {
  /// clock_seconds of a controller that sends no clock.
  static constexpr std::uint32_t kNoClock = 0xffffffff;
  static constexpr auto kUnknown = static_cast<std::int32_t>(kNotValidCode);

  std::array<std::uint16_t, kPartWords> part{};
  std::uint32_t clock_seconds = kNoClock;
  std::uint32_t clock_microseconds = 0;
  std::uint32_t sequence = 0;
  std::array<std::int32_t, kMachineValues.size()> values;  ///< value / its scale

  MachineRegisters() { values.fill(kUnknown); }
};

/// Holding registers written by PLCs.
struct PlcRegisters {
  CommandRegisters command;
  MachineRegisters machine;
  std::uint16_t heartbeat = 0;
  /// Number of the result acknowledged by the present request; 0: none.
  std::uint32_t result_acknowledged = 0;
};

/// A status with its UTC stamp.
struct StampedStatus {
  Status status;
  std::chrono::microseconds utc{0};  ///< exposure start of its frame set since 1970; 0: none yet
};

/// Snapshot made once per request, so that all values of one answer are consistent.
struct ProcessImage {
  StampedStatus live;
  StampedStatus result;                 ///< the oldest waiting result; number 0: none waits
  std::uint32_t last_acknowledged = 0;  ///< number of a result; 0: none yet
  ResultQueueStatus results;
  PlcRegisters written;
  PlcStatus plc;
  ServerStatus server;
  bool stale = false;    ///< the pipeline has been silent longer than the timeout
  hal::TimePoint now{};  ///< time of the request
};

template <class Visit>
constexpr void for_each_field(std::type_identity<ResultQueueStatus>, Visit&& visit) {
  using Part = ResultQueueStatus;
  ORBWATCH_MODBUS_RESULT_FIGURES(ORBWATCH_VISIT_FIELD)
}

template <class Visit>
constexpr void for_each_field(std::type_identity<PlcStatus>, Visit&& visit) {
  using Part = PlcStatus;
  ORBWATCH_MODBUS_PLC_FIGURES(ORBWATCH_VISIT_FIELD, ORBWATCH_VISIT_AGE)
}

template <class Visit>
constexpr void for_each_field(std::type_identity<ServerStatus>, Visit&& visit) {
  using Part = ServerStatus;
  ORBWATCH_MODBUS_SERVER_FIGURES(ORBWATCH_VISIT_FIELD)
}

}  // namespace orbwatch::app::modbus
