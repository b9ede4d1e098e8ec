#include "app/ports/modbus/server/rtu_transport.h"

#include <modbus.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <vector>

#include "app/ports/modbus/server/rtu_framer.h"

namespace orbwatch::app::modbus {
namespace {

bool is_broadcast(std::span<const std::uint8_t> request) {
  return request[0] == RtuFramer::kBroadcast;
}

char letter_of(Parity parity) {
  constexpr std::array kLetters{'N', 'E', 'O'};
  return kLetters[static_cast<std::size_t>(parity)];
}

Result<> check(const ModbusSerialSettings& settings) {
  const auto refused = [](const std::string& what) { return fail("modbus.serial: " + what); };
  if (settings.device.empty()) return refused("device is missing, as /dev/ttyUSB0");
  if (std::ranges::find(kBaudRates, settings.baud_rate) == kBaudRates.end()) {
    return refused("baud_rate " + std::to_string(settings.baud_rate) +
                   " is not one of 1200, 2400, ... 921600");
  }
  if (settings.stop_bits < 1 || settings.stop_bits > 2) return refused("stop_bits is not 1 or 2");
  if (settings.unit_id < 1 || settings.unit_id > 247) return refused("unit_id is not 1 to 247");
  return {};
}

}  // namespace

Result<std::unique_ptr<RtuTransport>> RtuTransport::create(const ModbusSerialSettings& settings) {
  if (auto checked = check(settings); !checked) return tl::unexpected(checked.error());
  auto context = prepared(modbus_new_rtu(settings.device.c_str(), settings.baud_rate,
                                         letter_of(settings.parity), 8, settings.stop_bits));
  if (!context) return tl::unexpected(context.error());
  return std::unique_ptr<RtuTransport>(new RtuTransport(std::move(*context), settings.device));
}

RtuTransport::~RtuTransport() { close(); }

Result<> RtuTransport::open() {
  if (modbus_connect(context_.get()) == 0) return {};
  return fail("modbus: cannot open the serial line " + device_ + ": " + modbus_strerror(errno) +
              "; check cable and device");
}

void RtuTransport::close() { modbus_close(context_.get()); }

int RtuTransport::descriptor() const { return modbus_get_socket(context_.get()); }

bool RtuTransport::refuse(std::span<const std::uint8_t> request, Exception exception) {
  return is_broadcast(request) || Transport::refuse(request, exception);
}

bool RtuTransport::send(std::span<const std::uint8_t> request, std::span<const std::uint8_t> pdu) {
  if (is_broadcast(request)) return true;
  std::vector<std::uint8_t> answer{request[0]};
  answer.insert(answer.end(), pdu.begin(), pdu.end());
  // "Raw request" means: libmodbus appends the checksum only. It suits answers as well.
  return modbus_send_raw_request(context_.get(), answer.data(), static_cast<int>(answer.size())) >=
         0;
}

}  // namespace orbwatch::app::modbus
