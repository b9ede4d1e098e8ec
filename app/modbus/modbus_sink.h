#pragma once

#include <memory>
#include <mutex>
#include <thread>

#include "app/commands.h"
#include "app/modbus/modbus_front.h"
#include "app/modbus/modbus_settings.h"
#include "app/modbus/plc_link.h"
#include "app/modbus/register_map.h"
#include "app/modbus/responder.h"
#include "app/modbus/result_queue.h"
#include "app/modbus/rtu_server.h"
#include "app/modbus/snapshot.h"
#include "app/pipeline/sink.h"

namespace orbwatch::app {

/// The Modbus server towards the PLC: serves the newest status by the register map, keeps results
/// until the PLC has taken them, and carries the PLC's commands out. One thread of its own for all
/// clients on TCP, and one for the serial line if there is any. The newest status wins; of results
/// the first ResultQueue::kDepth wait.
/// Thread rule: as Sink; statistics() is thread-safe, port() is for the thread of start().
class ModbusSink final : public Sink {
 public:
  /// `handler` is called on the sink's threads.
  ModbusSink(ModbusSettings settings, CommandHandler handler);
  ~ModbusSink() override;

  /// Errors: address or port cannot be used, or a setting is wrong; a serial line that is not there
  /// is waited for. Does nothing when the settings say so or it is
  /// started.
  Result<> start() override;
  void stop() override;

  void accept(const ViewPtr&) override {}  // registers show no pictures
  void accept(const Status& status) override;

  /// The port that is listened on, also when any was asked for; 0 while stopped.
  int port() const;

  modbus::Statistics statistics() const { return counters_.read(); }

 private:
  Result<> open_tcp();
  Result<> open_serial_line();
  modbus::Snapshot take() const;
  void write(const modbus::Write& write);

  const ModbusSettings settings_;
  const CommandHandler handler_;
  const modbus::RegisterMap map_;
  modbus::Counters counters_;
  mutable std::mutex mutex_;  ///< of these three, held to copy them only
  modbus::Moment newest_;
  hal::TimePoint received_at_;
  modbus::ResultQueue results_;
  hal::TimePoint start_;
  std::unique_ptr<modbus::PlcLink> plc_;
  std::unique_ptr<modbus::Responder> responder_;
  std::unique_ptr<modbus::TcpTransport> tcp_;
  std::unique_ptr<modbus::ModbusFront> front_;
  std::unique_ptr<modbus::RtuServer> serial_line_;
  std::thread tcp_thread_;
  std::thread serial_thread_;
};

}  // namespace orbwatch::app
