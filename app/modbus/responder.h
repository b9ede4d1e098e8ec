#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "app/modbus/register_map.h"
#include "app/modbus/request.h"
#include "app/modbus/transport.h"
#include "proc/image/result.h"

namespace orbwatch::app::modbus {

/// What became of a request.
enum class Answered : std::uint8_t {
  Done,
  Refused,  ///< with an exception
  // Not, and a connection is of no more use:
  NotModbus,
  NotTaken,  ///< the client does not read, or it is gone
};

/// Answers requests of any transport. libmodbus encodes and sends; it is only ever handed requests
/// that were checked against the map, and what it writes to its own image of the registers does not
/// count: of the image only what this request reads is used, and filled anew. Thread-safe: several
/// transports share the registers, one request after the other.
class Responder {
 public:
  using TakeSnapshot = std::function<Snapshot()>;
  using WriteRegisters = std::function<void(const Write&)>;

  /// `write` carries out what a PLC writes, checked, on the serving thread; `take` gives what a
  /// request reads, once per request and after it has written.
  static Result<std::unique_ptr<Responder>> create(const RegisterMap& map, WriteRegisters write,
                                                   TakeSnapshot take);

  /// Answers `frame`, one whole frame of `transport` with at least a function code. Does not wait.
  Answered answer(Transport& transport, std::span<const std::uint8_t> frame, bool may_write);

 private:
  struct Free {
    void operator()(_modbus_mapping_t* image) const;
  };
  using Image = std::unique_ptr<_modbus_mapping_t, Free>;

  Responder(const RegisterMap& map, WriteRegisters write, TakeSnapshot take, Image image);

  std::optional<Exception> carry_out_request(Request request, bool may_write);
  std::optional<Exception> check_access(const Request& request, bool may_write) const;
  void fill_image(const Range& range, const Snapshot& snapshot);
  std::vector<std::uint8_t> words(const Range& read) const;

  const RegisterMap& map_;
  const WriteRegisters write_;
  const TakeSnapshot take_;
  std::mutex mutex_;  ///< of what follows, and held while a request is carried out
  Image image_;
};

}  // namespace orbwatch::app::modbus
