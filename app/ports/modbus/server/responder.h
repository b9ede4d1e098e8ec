// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "app/ports/modbus/map/register_map.h"
#include "app/ports/modbus/server/request.h"
#include "app/ports/modbus/server/transport.h"
#include "proc/image/result.h"

namespace orbwatch::app::modbus {

/// Outcome of a request. The last two end a TCP connection.
enum class Outcome : std::uint8_t {
  Answered,
  Refused,    ///< answered with an exception
  Forbidden,  ///< refused with an exception, because the client may not write
  NotModbus,  ///< no answer
  NotSent,    ///< the client does not receive, or disconnected
};

/// Answers requests of any transport. libmodbus encodes and sends, and gets only requests that were
/// checked against the map. Of libmodbus' registers only those that the request reads are used,
/// filled from a process image each time; its writes to them are ignored. Thread-safe: several
/// transports share the registers, one request after the other.
class Responder {
 public:
  using MakeImage = std::function<ProcessImage()>;
  using WriteRegisters = std::function<std::optional<Exception>(const Write&)>;

  /// `write` executes a checked write on the serving thread; `make_image` is called once per
  /// request, after its write. Errors: no memory.
  static Result<std::unique_ptr<Responder>> create(const RegisterMap& map, WriteRegisters write,
                                                   MakeImage make_image);

  /// Answers `frame`, one complete frame of `transport` with at least a function code. Does not
  /// wait.
  Outcome answer(Transport& transport, std::span<const std::uint8_t> frame, bool may_write);

 private:
  using Mapping = std::unique_ptr<_modbus_mapping_t, void (*)(_modbus_mapping_t*)>;

  Responder(const RegisterMap& map, WriteRegisters write, MakeImage make_image, Mapping mapping);

  std::optional<Exception> execute(Request request);
  std::optional<Exception> check_access(const Request& request) const;
  void fill_mapping(const Range& range, const ProcessImage& image);
  std::vector<std::uint8_t> read_write_answer(const Range& read) const;

  const RegisterMap& map_;
  const WriteRegisters write_;
  const MakeImage make_image_;
  std::mutex mutex_;  ///< guards the following members, and held while a request is executed
  Mapping mapping_;
};

}  // namespace orbwatch::app::modbus
