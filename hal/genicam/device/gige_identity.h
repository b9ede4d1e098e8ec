// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace orbwatch::hal {

/// Identity of the camera at an address, from the bootstrap registers that every GigE Vision camera
/// has.
struct GigeIdentity {
  std::string model;
  std::string serial;
  std::string name;  ///< name given by its user; may be empty
};

/// True for four numbers: "192.168.7.20".
bool is_ip_address(const std::string& text);

/// Reads the identity of the camera at an IP address without taking control of it; nullopt when
/// none answers within about half a second. Reentrant.
std::optional<GigeIdentity> read_gige_identity(const std::string& address);

/// The data in a camera's answer to READMEM (GigE Vision, control protocol), or nullopt when it
/// does not answer this request.
std::optional<std::string> memory_in_answer(std::span<const std::byte> answer,
                                            std::uint16_t request_id, std::uint32_t address,
                                            std::size_t size);

}  // namespace orbwatch::hal
