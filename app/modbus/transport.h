#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "app/modbus/request.h"
#include "proc/image/result.h"

// libmodbus' own names for what its header declares.
struct _modbus;
struct _modbus_mapping_t;

namespace orbwatch::app::modbus {

/// How the answers to requests leave: libmodbus, which puts them into the frames of one kind of
/// line. It never reads here and never waits. What is called `request` is the whole frame that is
/// answered. Thread-bound.
class Transport {
 public:
  virtual ~Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  /// The protocol data unit (function code and data) in a whole frame.
  std::span<const std::uint8_t> pdu_of(std::span<const std::uint8_t> frame) const {
    return frame.subspan(header_, frame.size() - header_ - checksum_);
  }

  /// Is the request for this device, and not for another?
  virtual bool is_ours(std::span<const std::uint8_t> request) const = 0;

  /// Answers from `image`, in which all that is asked for must be. These three return false when
  /// the answer was not taken, whole and at once.
  bool reply(std::span<const std::uint8_t> request, _modbus_mapping_t& image);
  virtual bool refuse(std::span<const std::uint8_t> request, Exception exception);
  /// Answers with a protocol data unit that libmodbus does not know.
  virtual bool send(std::span<const std::uint8_t> request, std::span<const std::uint8_t> pdu) = 0;

 protected:
  struct Free {
    void operator()(_modbus* context) const;
  };
  using Context = std::unique_ptr<_modbus, Free>;

  /// `checksum`: bytes behind the protocol data unit.
  Transport(Context context, std::size_t checksum);

  /// Makes a context fit for answering; the error is that there is none.
  static Result<Context> prepared(_modbus* context);

  Context context_;

 private:
  std::size_t header_;
  std::size_t checksum_;
};

/// Modbus TCP: one for all connections.
class TcpTransport final : public Transport {
 public:
  /// Requests for other units than these get the exception of a gateway that finds no such device.
  static Result<std::unique_ptr<TcpTransport>> create(std::vector<int> unit_ids);

  /// Where the next answers go. The socket must not block.
  void use(int socket);

  bool is_ours(std::span<const std::uint8_t> request) const override;
  bool send(std::span<const std::uint8_t> request, std::span<const std::uint8_t> pdu) override;

 private:
  TcpTransport(Context context, std::vector<int> unit_ids)
      : Transport(std::move(context), 0), unit_ids_(std::move(unit_ids)) {}

  std::vector<int> unit_ids_;
};

}  // namespace orbwatch::app::modbus
