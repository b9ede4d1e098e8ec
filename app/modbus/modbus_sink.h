#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <thread>

#include "app/commands.h"
#include "app/modbus/modbus_front.h"
#include "app/modbus/modbus_settings.h"
#include "app/modbus/register_map.h"
#include "app/modbus/responder.h"
#include "app/modbus/snapshot.h"
#include "app/pipeline/sink.h"

namespace orbwatch::app {

/// The Modbus TCP server towards the PLC: serves the newest status by the register map and carries
/// the PLC's commands out. One thread of its own for all clients; the newest status wins, nothing
/// is queued.
/// Thread rule: as Sink; statistics() is thread-safe, port() is for the thread of start().
class ModbusSink final : public Sink {
 public:
  /// `handler` is called on the sink's thread.
  ModbusSink(ModbusSettings settings, CommandHandler handler);
  ~ModbusSink() override;

  /// Errors: address or port cannot be used. Does nothing when the settings say so or it is
  /// started.
  Result<> start() override;
  void stop() override;

  void accept(const ViewPtr&) override {}  // registers show no pictures
  void accept(const Status& status) override;

  /// The port that is listened on, also when any was asked for; 0 while stopped.
  int port() const;

  modbus::Statistics statistics() const { return counters_.read(); }

 private:
  /// The newest status and what must be known about the moment it came.
  struct Received {
    Status status;
    std::chrono::microseconds utc{0};
    hal::TimePoint at;
  };

  modbus::Snapshot take() const;

  const ModbusSettings settings_;
  const CommandHandler handler_;
  const modbus::RegisterMap map_;
  modbus::Counters counters_;
  mutable std::mutex mutex_;
  Received received_;
  std::unique_ptr<modbus::Responder> responder_;
  std::unique_ptr<modbus::ModbusFront> front_;
  std::thread thread_;
};

}  // namespace orbwatch::app
