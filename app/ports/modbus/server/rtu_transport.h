#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "app/ports/modbus/modbus_settings.h"
#include "app/ports/modbus/server/transport.h"

namespace orbwatch::app::modbus {

/// Modbus RTU on a serial line configured by libmodbus. libmodbus' receiver is not used: it does
/// not find the end of a request with an unknown function, and after a request for another unit it
/// expects that unit's answer, although the next frame may be a request for this one.
class RtuTransport final : public Transport {
 public:
  /// Does not open the line. Errors: a setting that is not allowed.
  static Result<std::unique_ptr<RtuTransport>> create(const ModbusSerialSettings& settings);
  ~RtuTransport() override;

  /// Errors: the line cannot be used now, and why.
  Result<> open();
  void close();

  /// Of the open line, non-blocking, for reading.
  int descriptor() const;

  /// RtuFramer returns no others.
  bool is_ours(std::span<const std::uint8_t> /*request*/) const override { return true; }
  /// Broadcasts get no answer.
  bool refuse(std::span<const std::uint8_t> request, Exception exception) override;
  bool send(std::span<const std::uint8_t> request, std::span<const std::uint8_t> pdu) override;

 private:
  RtuTransport(Context context, std::string device)
      : Transport(std::move(context), kChecksum), device_(std::move(device)) {}

  static constexpr std::size_t kChecksum = 2;
  const std::string device_;
};

}  // namespace orbwatch::app::modbus
