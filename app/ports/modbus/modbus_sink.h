// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "app/model/command/command.h"
#include "app/model/machine/machine_state.h"
#include "app/model/sink/sink.h"
#include "app/ports/modbus/map/process_image.h"
#include "app/ports/modbus/map/register_map.h"
#include "app/ports/modbus/modbus_settings.h"
#include "app/ports/modbus/plc_handshake.h"
#include "app/ports/modbus/result_queue.h"
#include "app/ports/modbus/server/responder.h"
#include "app/ports/modbus/server/rtu_server.h"
#include "app/ports/modbus/server/seen_hosts.h"
#include "app/ports/modbus/server/tcp_server.h"
#include "app/state/command_record.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// The Modbus server for PLCs: serves the newest status by the register map, keeps results until
/// they are acknowledged, and executes commands. One thread for all clients on TCP, one for the
/// serial line if configured, one for commands, which wait for the disk, and one that supervises
/// the PLC if its heartbeat has a timeout, whichever line it uses. The newest status wins; up to
/// ResultQueue::kDepth results wait, the oldest ones. Thread rule: as Sink; statistics() is
/// thread-safe, port() is for the thread of start().
class ModbusSink final : public Sink {
 public:
  /// The handlers of commands and of the machine's states are called on the sink's threads.
  ModbusSink(ModbusSettings settings, CommandHandler handler,
             std::shared_ptr<CommandRecord> record = std::make_shared<CommandRecord>(),
             MachinePath machine = {});
  ~ModbusSink() override;

  /// Error: address or port cannot be used; the serial line is then served already. A serial line
  /// that is not connected is not an error; opening it is retried. Does nothing when disabled or
  /// already started.
  Result<> start() override;
  void stop() override;
  bool works() const override { return !serial_is_lost_; }
  std::chrono::nanoseconds cpu_time() const override;

  /// Tables of registers with their values, and of the clients on TCP.
  std::vector<InterfaceTable> tables() const override;
  /// Figures of the server, the queue of results and the PLC; none while stopped.
  std::vector<InterfaceMetric> metrics() const override;

  void accept(const ViewPtr&) override {}  // Modbus serves no pictures
  void accept(const Status& status) override;

  /// The actual listening port; 0 while stopped.
  int port() const;

  modbus::ServerStatus statistics() const { return counters_.read(); }

 private:
  Result<> make_responder();
  void start_supervision();
  Result<> open_tcp();
  Result<> open_serial_line();
  modbus::ProcessImage process_image() const;
  std::optional<modbus::Exception> write(const modbus::Write& write);
  void report_forbidden(int socket);

  const ModbusSettings settings_;
  const CommandHandler handler_;
  const MachinePath machine_;
  const std::shared_ptr<CommandRecord> record_;
  const modbus::RegisterMap map_;
  modbus::ServerCounters counters_;
  mutable std::mutex served_;         ///< held while servers are created, stopped or listed
  mutable hal::PriorityMutex mutex_;  ///< guards the next three members, held only for copies
  modbus::StampedStatus newest_;
  hal::TimePoint received_at_;
  modbus::ResultQueue results_;
  hal::TimePoint start_;
  std::atomic<bool> serial_is_lost_{false};
  std::unique_ptr<modbus::PlcHandshake> plc_;
  std::unique_ptr<modbus::Responder> responder_;
  std::unique_ptr<modbus::TcpTransport> tcp_transport_;
  std::unique_ptr<modbus::TcpServer> tcp_;
  modbus::SeenHosts forbidden_;  ///< hosts whose writes were refused; used by the TCP thread only
  std::unique_ptr<modbus::RtuServer> serial_line_;
  hal::Thread tcp_thread_;
  hal::Thread serial_thread_;
  hal::Thread command_thread_;
  hal::Thread supervision_thread_;
};

}  // namespace orbwatch::app
