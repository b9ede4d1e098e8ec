#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace orbwatch::hal {

/// Who answers at an address, by the bootstrap registers that every GigE Vision camera has.
struct GigeIdentity {
  std::string model;
  std::string serial;
  std::string name;  ///< that its user gave to it; may be empty
};

/// True for four numbers: "192.168.7.20".
bool is_ip_address(const std::string& text);

/// Asks the camera at an IP address without taking control of it; nullopt when none answers within
/// about half a second. Reentrant.
std::optional<GigeIdentity> read_gige_identity(const std::string& address);

/// The data in a camera's answer to READMEM (GigE Vision, control protocol), or nullopt when it is
/// none to this request.
std::optional<std::string> memory_in_answer(std::span<const std::byte> answer,
                                            std::uint16_t request_id, std::uint32_t address,
                                            std::size_t size);

}  // namespace orbwatch::hal
