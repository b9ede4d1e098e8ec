// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/modbus_sink.h"

#include <sys/socket.h>

#include <chrono>
#include <utility>

#include "app/log.h"
#include "app/ports/modbus/machine_registers.h"
#include "app/ports/modbus/map/register_table.h"
#include "hal/socket_address.h"

namespace orbwatch::app {

using std::chrono::microseconds;

namespace {

/// List in TOML: ["10.0.0.7", "10.0.0.8"].
std::string quoted(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "\"" : ", \"") + text + "\"";
  return "[" + list + "]";
}

/// Makes a silent pipeline's last status a fault, in which nothing measured or reported is valid.
void forget_live(Status& status) {
  status.state = SystemState::Fault;
  status.regions = {};
  if (status.machine.quality == MachineQuality::NotConfigured) return;
  status.machine.forget(MachineQuality::Stale);
}

}  // namespace

ModbusSink::ModbusSink(ModbusSettings settings, CommandHandler handler,
                       std::shared_ptr<CommandRecord> record, MachinePath machine)
    : settings_(std::move(settings)),
      handler_(std::move(handler)),
      machine_(std::move(machine)),
      record_(std::move(record)) {}

ModbusSink::~ModbusSink() { stop(); }

Result<> ModbusSink::start() {
  if (!settings_.enabled || tcp_) return {};
  const std::lock_guard lock(served_);
  if (auto made = make_responder(); !made) return made;
  if (auto opened = open_serial_line(); !opened) return opened;
  return open_tcp();
}

Result<> ModbusSink::make_responder() {
  if (responder_) return {};
  start_ = hal::Clock::now();
  const std::chrono::duration<double, std::milli> plc_timeout(settings_.plc_timeout_ms);
  plc_ = std::make_unique<modbus::PlcHandshake>(
      *record_, handler_, std::chrono::duration_cast<hal::Clock::duration>(plc_timeout), start_);
  auto responder = modbus::Responder::create(
      map_, [this](const modbus::Write& registers) { return write(registers); },
      [this] { return process_image(); });
  if (!responder) return tl::unexpected(responder.error());
  responder_ = std::move(*responder);
  command_thread_.start("modbus commands", [this] {
    while (command_thread_.wait()) plc_->carry_out();
    plc_->carry_out();  // a command written before stop()
  });
  start_supervision();
  const std::lock_guard lock(mutex_);
  received_at_ = hal::Clock::now();  // starts the status timeout
  return {};
}

/// Supervises on a separate thread, so that neither a closed line nor a command that waits for the
/// disk delays it.
void ModbusSink::start_supervision() {
  if (settings_.plc_timeout_ms == 0) return;
  supervision_thread_.start("modbus plc", [this] {
    while (supervision_thread_.wait_until(plc_->supervise(hal::Clock::now()))) {
    }
  });
}

Result<> ModbusSink::open_tcp() {
  auto transport = modbus::TcpTransport::create(settings_.unit_ids);
  if (!transport) return tl::unexpected(transport.error());
  tcp_transport_ = std::move(*transport);
  auto server = modbus::TcpServer::open(
      settings_,
      [this](int socket, std::span<const std::uint8_t> frame, bool may_write) {
        tcp_transport_->use(socket);
        const modbus::Outcome outcome = responder_->answer(*tcp_transport_, frame, may_write);
        if (outcome == modbus::Outcome::Forbidden) report_forbidden(socket);
        return outcome;
      },
      counters_);
  if (!server) return tl::unexpected(server.error());
  tcp_ = std::move(*server);
  tcp_thread_.start("modbus", [this] { tcp_->run(); });
  return {};
}

/// Logs a refused write once per host, with the setting that would permit it.
void ModbusSink::report_forbidden(int socket) {
  hal::SocketAddress peer;
  if (::getpeername(socket, peer.get(), &peer.length) != 0) return;  // the client has disconnected
  const modbus::HostAddress host = peer.host();
  if (!forbidden_.is_new(host)) return;
  std::vector<std::string> writers = settings_.writers;
  writers.push_back(hal::text_of(host));
  // Other clients wait for this thread. A list too long for the log is cut at its end.
  log_soon(LogLevel::Warning,
           {"modbus: write refused to ", writers.back(),
            "; to permit it, set in [modbus] of the site file: writers = ", quoted(writers)});
}

Result<> ModbusSink::open_serial_line() {
  if (!settings_.serial || serial_line_) return {};
  auto server = modbus::RtuServer::open(
      *settings_.serial,
      [this](modbus::Transport& transport, std::span<const std::uint8_t> frame) {
        return responder_->answer(transport, frame, settings_.serial->may_write);
      },
      [this](const Result<>& line) {
        serial_is_lost_ = !line;
        log_soon(line ? LogLevel::Info : LogLevel::Warning,
                 {line ? "modbus: the serial line " + settings_.serial->device + " is back"
                       : line.error().message});
      },
      counters_,
      [this] {
        log_line(LogLevel::Warning,
                 "modbus: the serial line " + settings_.serial->device +
                     " echoes sent answers, because its adapter receives while it sends; the "
                     "echoes are dropped. Disable the echo if the adapter has a switch");
      });
  if (!server) return tl::unexpected(server.error());
  serial_line_ = std::move(*server);
  serial_thread_.start("modbus rtu", [this] { serial_line_->run(); });
  return {};
}

void ModbusSink::stop() {
  if (tcp_) tcp_->stop();
  if (serial_line_) serial_line_->stop();
  tcp_thread_.stop();
  serial_thread_.stop();
  command_thread_.stop();
  supervision_thread_.stop();
  const std::lock_guard lock(served_);
  tcp_.reset();
  serial_line_.reset();
  tcp_transport_.reset();
  responder_.reset();
  counters_.connections = 0;
}

std::vector<InterfaceTable> ModbusSink::tables() const {
  const std::lock_guard lock(served_);
  if (!responder_) return {};
  const modbus::ProcessImage image = process_image();
  InterfaceTable clients{"modbus", "clients", {"address", "may_write", "requests", "idle_s"}, {}};
  for (const auto& client : tcp_ ? tcp_->clients() : std::vector<modbus::TcpServer::Client>()) {
    const std::chrono::duration<double> idle = image.now - client.last_request;
    clients.rows.push_back({hal::text_of(client.host), client.may_write,
                            static_cast<double>(client.requests), idle.count()});
  }
  return {modbus::register_table(map_, image), std::move(clients)};
}

std::vector<InterfaceMetric> ModbusSink::metrics() const {
  const std::lock_guard lock(served_);
  if (!responder_) return {};
  const modbus::ProcessImage image = process_image();
  std::vector<InterfaceMetric> all;
  add_metrics(all, {"modbus"}, image.server, image.now);
  add_metrics(all, {"modbus_results"}, image.results, image.now);
  add_metrics(all, {"modbus_plc"}, image.plc, image.now);
  return all;
}

std::chrono::nanoseconds ModbusSink::cpu_time() const {
  return tcp_thread_.cpu_time() + serial_thread_.cpu_time() + command_thread_.cpu_time() +
         supervision_thread_.cpu_time();
}

void ModbusSink::accept(const Status& status) {
  const auto now = hal::Clock::now();
  const auto utc = hal::to_utc(status.stamp).time_since_epoch();
  const std::lock_guard lock(mutex_);
  // Converted once per frame set, because conversions of the clocks differ by about a microsecond.
  if (status.frame_set != newest_.status.frame_set || status.stamp != newest_.status.stamp) {
    newest_.utc =
        status.frame_set == 0 ? microseconds(0) : std::chrono::duration_cast<microseconds>(utc);
  }
  const bool is_result = status.result != 0 && status.result != newest_.status.result;
  newest_.status = status;
  received_at_ = now;
  if (is_result) results_.push(newest_);
}

int ModbusSink::port() const { return tcp_ ? tcp_->port() : 0; }

std::optional<modbus::Exception> ModbusSink::write(const modbus::Write& write) {
  if (modbus::writes_machine_state(write.range)) {
    const auto refused = modbus::take_machine_state(write, map_, machine_);
    if (refused) return refused;
  }
  const std::uint32_t acknowledged = plc_->write(write, map_, hal::Clock::now());
  if (plc_->has_command()) command_thread_.wake();
  const std::lock_guard lock(mutex_);
  if (acknowledged != 0) results_.acknowledge(acknowledged);
  return std::nullopt;
}

modbus::ProcessImage ModbusSink::process_image() const {
  modbus::ProcessImage image;
  image.now = hal::Clock::now();
  image.server = counters_.read();
  image.server.uptime = static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::seconds>(image.now - start_).count());
  image.written = plc_->registers();
  image.plc = plc_->status(image.now);
  {
    const std::lock_guard lock(mutex_);
    image.live = newest_;
    image.result = results_.oldest();
    image.results = results_.status();
    image.last_acknowledged = results_.last_acknowledged();
    image.stale = image.now - received_at_ > settings_.status_timeout;
  }
  if (image.stale) forget_live(image.live.status);
  return image;
}

std::string commanders(const ModbusSettings& settings) {
  if (!settings.enabled) return {};
  std::string text = "over Modbus from " +
                     (settings.writers.empty() ? "this host only" : quoted(settings.writers));
  if (settings.serial && settings.serial->may_write) {
    text += " and on the serial line " + settings.serial->device;
  }
  return text;
}

std::unique_ptr<Sink> make_sink(const ModbusSettings& settings, const CommandPath& commands,
                                const MachinePath& machine) {
  if (!settings.enabled) return nullptr;
  return std::make_unique<ModbusSink>(settings, commands.handler, commands.record, machine);
}

}  // namespace orbwatch::app
