#include "app/modbus/modbus_sink.h"

#include <utility>

namespace orbwatch::app {

using std::chrono::microseconds;
using std::chrono::milliseconds;

ModbusSink::ModbusSink(ModbusSettings settings, CommandHandler handler)
    : settings_(std::move(settings)), handler_(std::move(handler)) {}

ModbusSink::~ModbusSink() { stop(); }

Result<> ModbusSink::start() {
  if (!settings_.enabled || front_) return {};
  auto responder = modbus::Responder::create(map_, handler_, [this] { return take(); });
  if (!responder) return tl::unexpected(responder.error());
  responder_ = std::move(*responder);
  auto front = modbus::ModbusFront::open(
      settings_,
      [this](int socket, std::span<const std::uint8_t> frame, bool may_write) {
        return responder_->answer(socket, frame, may_write);
      },
      counters_);
  if (!front) return tl::unexpected(front.error());
  front_ = std::move(*front);
  {
    const std::lock_guard lock(mutex_);
    received_.at = hal::Clock::now();  // from here on the pipeline's silence counts
  }
  thread_ = std::thread([this] { front_->run(); });
  return {};
}

void ModbusSink::stop() {
  if (!front_) return;
  front_->stop();
  thread_.join();
  front_.reset();
  responder_.reset();
  counters_.connections = 0;
}

void ModbusSink::accept(const Status& status) {
  const auto now = hal::Clock::now();
  const auto utc = hal::to_utc(status.stamp).time_since_epoch();
  const std::lock_guard lock(mutex_);
  // Once per frame set: measured again it would come out a microsecond different each time.
  if (status.stamp != received_.status.stamp) {
    received_.utc = std::chrono::duration_cast<microseconds>(utc);
  }
  received_.status = status;
  received_.at = now;
}

int ModbusSink::port() const { return front_ ? front_->port() : 0; }

modbus::Snapshot ModbusSink::take() const {
  Received received;
  {
    const std::lock_guard lock(mutex_);
    received = received_;
  }
  const auto now = hal::Clock::now();
  modbus::Snapshot snapshot;
  snapshot.status = received.status;
  snapshot.server = counters_.read();
  snapshot.stale = now - received.at > settings_.status_timeout;
  if (snapshot.stale) {
    snapshot.status.state = SystemState::Fault;
    snapshot.status.signals = {};
  }
  const bool any = received.status.frame_set != 0;
  snapshot.utc = any ? received.utc : microseconds(0);
  snapshot.age = any ? std::chrono::duration_cast<milliseconds>(now - received.status.stamp)
                     : milliseconds::max();
  return snapshot;
}

}  // namespace orbwatch::app
