#include "app/modbus/modbus_sink.h"

#include <chrono>
#include <utility>

#include "app/log.h"

namespace orbwatch::app {

using std::chrono::microseconds;

ModbusSink::ModbusSink(ModbusSettings settings, CommandHandler handler)
    : settings_(std::move(settings)), handler_(std::move(handler)) {}

ModbusSink::~ModbusSink() { stop(); }

Result<> ModbusSink::start() {
  if (!settings_.enabled || front_) return {};
  start_ = hal::Clock::now();
  const std::chrono::duration<double, std::milli> plc_timeout(settings_.plc_timeout_ms);
  plc_ = std::make_unique<modbus::PlcLink>(
      handler_, std::chrono::duration_cast<hal::Clock::duration>(plc_timeout), start_);
  auto responder = modbus::Responder::create(
      map_, [this](const modbus::Write& registers) { write(registers); },
      [this] { return take(); });
  if (!responder) return tl::unexpected(responder.error());
  responder_ = std::move(*responder);
  if (auto opened = open_serial_line(); !opened) return opened;
  if (auto opened = open_tcp(); !opened) return opened;
  {
    const std::lock_guard lock(mutex_);
    received_at_ = hal::Clock::now();  // from here on the pipeline's silence counts
  }
  tcp_thread_ = std::thread([this] { front_->run(); });
  if (serial_line_) serial_thread_ = std::thread([this] { serial_line_->run(); });
  return {};
}

Result<> ModbusSink::open_tcp() {
  auto tcp = modbus::TcpTransport::create(settings_.unit_ids);
  if (!tcp) return tl::unexpected(tcp.error());
  tcp_ = std::move(*tcp);
  auto front = modbus::ModbusFront::open(
      settings_,
      [this](int socket, std::span<const std::uint8_t> frame, bool may_write) {
        tcp_->use(socket);
        return responder_->answer(*tcp_, frame, may_write);
      },
      [this] { return plc_->watch(hal::Clock::now()); }, counters_);
  if (!front) return tl::unexpected(front.error());
  front_ = std::move(*front);
  return {};
}

Result<> ModbusSink::open_serial_line() {
  if (!settings_.serial) return {};
  auto server = modbus::RtuServer::open(
      *settings_.serial,
      [this](modbus::Transport& transport, std::span<const std::uint8_t> frame) {
        return responder_->answer(transport, frame, settings_.serial->may_write);
      },
      [this](const Result<>& line) {
        log_line(line ? LogLevel::Info : LogLevel::Warning,
                 line ? "modbus: the serial line " + settings_.serial->device + " is back"
                      : line.error().message);
      },
      counters_);
  if (!server) return tl::unexpected(server.error());
  serial_line_ = std::move(*server);
  return {};
}

void ModbusSink::stop() {
  if (!front_) return;
  front_->stop();
  if (serial_line_) serial_line_->stop();
  tcp_thread_.join();
  if (serial_line_) serial_thread_.join();
  front_.reset();
  serial_line_.reset();
  tcp_.reset();
  responder_.reset();
  counters_.connections = 0;
}

void ModbusSink::accept(const Status& status) {
  const auto now = hal::Clock::now();
  const auto utc = hal::to_utc(status.stamp).time_since_epoch();
  const std::lock_guard lock(mutex_);
  // Once per frame set: measured again it would come out a microsecond different each time.
  if (status.frame_set != newest_.status.frame_set || status.stamp != newest_.status.stamp) {
    newest_.utc =
        status.frame_set == 0 ? microseconds(0) : std::chrono::duration_cast<microseconds>(utc);
  }
  const bool is_result = status.result != 0 && status.result != newest_.status.result;
  newest_.status = status;
  received_at_ = now;
  if (is_result) results_.push(newest_);
}

int ModbusSink::port() const { return front_ ? front_->port() : 0; }

void ModbusSink::write(const modbus::Write& write) {
  const std::uint32_t taken = plc_->write(write, map_, hal::Clock::now());
  const std::lock_guard lock(mutex_);
  if (taken != 0) results_.take(taken);
}

modbus::Snapshot ModbusSink::take() const {
  modbus::Snapshot snapshot;
  snapshot.now = hal::Clock::now();
  snapshot.start = start_;
  snapshot.server = counters_.read();
  snapshot.plc = plc_->state(snapshot.now);
  {
    const std::lock_guard lock(mutex_);
    snapshot.live = newest_;
    snapshot.results = results_.waiting();
    snapshot.stale = snapshot.now - received_at_ > settings_.status_timeout;
  }
  if (snapshot.stale) {
    snapshot.live.status.state = SystemState::Fault;
    snapshot.live.status.regions = {};
  }
  return snapshot;
}

}  // namespace orbwatch::app
