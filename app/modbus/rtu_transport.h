#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "app/modbus/modbus_settings.h"
#include "app/modbus/transport.h"

namespace orbwatch::app::modbus {

/// Modbus RTU on a serial line, which libmodbus sets up. Its own receiving is not used: it cannot
/// tell where a request of a function that it does not know ends, and takes what follows another
/// unit's request for that unit's answer, be it a request for this one.
class RtuTransport final : public Transport {
 public:
  /// Opens nothing yet. Errors: a setting that is not allowed.
  static Result<std::unique_ptr<RtuTransport>> create(const ModbusSerialSettings& settings);
  ~RtuTransport() override;

  /// The error says why the line cannot be used now.
  Result<> open();
  void close();

  /// Of the open line, which does not block, for reading.
  int descriptor() const;

  /// RtuFramer gives no others.
  bool is_ours(std::span<const std::uint8_t> /*request*/) const override { return true; }
  /// Requests to all get no answer, of any kind.
  bool refuse(std::span<const std::uint8_t> request, Exception exception) override;
  bool send(std::span<const std::uint8_t> request, std::span<const std::uint8_t> pdu) override;

 private:
  RtuTransport(Context context, std::string device)
      : Transport(std::move(context), kChecksum), device_(std::move(device)) {}

  static constexpr std::size_t kChecksum = 2;
  const std::string device_;
};

}  // namespace orbwatch::app::modbus
