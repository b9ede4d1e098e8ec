#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "app/commands.h"
#include "app/modbus/register_map.h"
#include "app/modbus/request.h"

// libmodbus' own names for what its header declares.
struct _modbus;            // NOLINT(bugprone-reserved-identifier)
struct _modbus_mapping_t;  // NOLINT(bugprone-reserved-identifier)

namespace orbwatch::app::modbus {

/// What became of a request.
enum class Answered : std::uint8_t {
  Done,
  Refused,  ///< with an exception
  // Not, and the connection is of no more use:
  NotModbus,
  NotTaken,  ///< the client does not read, or it is gone
};

/// Answers one request after the other. libmodbus encodes and sends; it is only ever handed
/// requests that were checked against the map, and what it writes to its own image of the registers
/// does not count: the image is filled anew for each request. Thread rule: thread-bound to the
/// thread that serves the sockets.
class Responder {
 public:
  using TakeSnapshot = std::function<Snapshot()>;

  /// `carry_out` runs the PLC's commands on the serving thread; `take` gives what a request is
  /// answered from, without the command registers.
  static Result<std::unique_ptr<Responder>> create(const RegisterMap& map, CommandHandler handler,
                                                   TakeSnapshot take);

  /// Answers `frame`, one whole frame with its MBAP header of 7 bytes and at least a function code,
  /// on `socket`, which must not block.
  Answered answer(int socket, std::span<const std::uint8_t> frame, bool may_write);

 private:
  struct Free {
    void operator()(_modbus* context) const;
    void operator()(_modbus_mapping_t* image) const;
  };
  using Context = std::unique_ptr<_modbus, Free>;
  using Image = std::unique_ptr<_modbus_mapping_t, Free>;

  Responder(const RegisterMap& map, CommandHandler handler, TakeSnapshot take, Context context,
            Image image);

  Answered refuse(std::span<const std::uint8_t> frame, Exception exception);
  Answered answer_identification(int socket, std::span<const std::uint8_t> frame);
  std::optional<Exception> check_access(const Request& request, bool may_write) const;
  void fill_image(const Snapshot& snapshot);

  const RegisterMap& map_;
  CommandHandler handler_;
  TakeSnapshot take_;
  CommandRegisters command_;
  Context context_;
  Image image_;
};

}  // namespace orbwatch::app::modbus
