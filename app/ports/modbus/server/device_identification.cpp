// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/device_identification.h"

#include <array>
#include <string_view>

namespace orbwatch::app::modbus {
namespace {

constexpr std::uint8_t kReadDeviceIdentification = 14;
constexpr std::uint8_t kIndividual = 4;
constexpr std::uint8_t kBasicStreamAndIndividual = 0x81;  // conformity level

/// Objects by id: VendorName, ProductCode, MajorMinorRevision.
constexpr std::array<std::string_view, 3> kObjects{"orbwatch", "orbwatch", ORBWATCH_VERSION};

}  // namespace

tl::expected<std::vector<std::uint8_t>, Exception> identify(std::span<const std::uint8_t> pdu) {
  if (pdu.size() < 2 || pdu[1] != kReadDeviceIdentification) {
    return tl::unexpected(Exception::IllegalFunction);
  }
  if (pdu.size() != 4) return tl::unexpected(Exception::IllegalDataValue);
  const std::uint8_t category = pdu[2];
  if (category < 1 || category > kIndividual) return tl::unexpected(Exception::IllegalDataValue);

  std::size_t first = pdu[3];
  std::size_t end = kObjects.size();
  if (category == kIndividual) {
    if (first >= end) return tl::unexpected(Exception::IllegalDataAddress);
    end = first + 1;
  } else if (first >= end) {
    first = 0;  // the standard restarts the stream for an unknown object
  }
  std::vector<std::uint8_t> answer{kEncapsulatedInterface,
                                   kReadDeviceIdentification,
                                   category,
                                   kBasicStreamAndIndividual,
                                   0,  // nothing follows
                                   0,  // so no next object
                                   static_cast<std::uint8_t>(end - first)};
  for (std::size_t id = first; id < end; ++id) {
    answer.push_back(static_cast<std::uint8_t>(id));
    answer.push_back(static_cast<std::uint8_t>(kObjects[id].size()));
    answer.insert(answer.end(), kObjects[id].begin(), kObjects[id].end());
  }
  return answer;
}

}  // namespace orbwatch::app::modbus
