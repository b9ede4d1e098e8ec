// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/ports/modbus/modbus_settings.h"
#include "app/ports/modbus/server/request.h"
#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

// Names that libmodbus' header declares.
struct _modbus;
struct _modbus_mapping_t;

namespace orbwatch::app::modbus {

/// Sends answers with libmodbus, which frames them for one kind of line. Never reads, never waits.
/// `request` is always the complete frame being answered. Thread-bound.
class Transport {
 public:
  virtual ~Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  /// The protocol data unit (function code and data) of a complete frame.
  std::span<const std::uint8_t> pdu_of(std::span<const std::uint8_t> frame) const {
    return frame.subspan(header_, frame.size() - header_ - checksum_);
  }

  /// Returns whether the request addresses one of our units.
  virtual bool is_ours(std::span<const std::uint8_t> request) const = 0;

  /// Answers from `mapping`, which must hold all registers of the request. These three return false
  /// if the answer cannot be sent at once.
  bool reply(std::span<const std::uint8_t> request, _modbus_mapping_t& mapping);
  virtual bool refuse(std::span<const std::uint8_t> request, Exception exception);
  /// Answers with a protocol data unit of a function that libmodbus does not support.
  virtual bool send(std::span<const std::uint8_t> request, std::span<const std::uint8_t> pdu) = 0;

 protected:
  using Context = std::unique_ptr<_modbus, void (*)(_modbus*)>;

  /// `checksum`: number of bytes after the protocol data unit.
  Transport(Context context, std::size_t checksum);

  /// Prepares a context for answering. Errors: `context` is nullptr.
  static Result<Context> prepared(_modbus* context);

  /// Called after libmodbus has written an answer. False: not sent.
  virtual bool deliver() { return true; }

  Context context_;

 private:
  std::size_t header_;
  std::size_t checksum_;
};

/// Modbus TCP: one transport for all connections.
class TcpTransport final : public Transport {
 public:
  /// Requests for other units get exception 11, as from a gateway without such a device.
  static Result<std::unique_ptr<TcpTransport>> create(std::vector<int> unit_ids);

  /// Sets the socket of the next answers, non-blocking.
  void use(int socket);

  bool is_ours(std::span<const std::uint8_t> request) const override;
  bool send(std::span<const std::uint8_t> request, std::span<const std::uint8_t> pdu) override;

 private:
  TcpTransport(Context context, std::vector<int> unit_ids)
      : Transport(std::move(context), 0), unit_ids_(std::move(unit_ids)) {}

  std::vector<int> unit_ids_;
};

/// Modbus RTU on a serial line configured by libmodbus. libmodbus' receiver is not used: it does
/// not detect the end of a request with an unknown function, and after a request for another unit
/// it expects that unit's answer, although the next frame may be a request for this one. libmodbus
/// writes answers into a pipe, so that their bytes are known for the echo filter.
class RtuTransport final : public Transport {
 public:
  /// Creates a transport without opening the line. Errors: an invalid setting.
  static Result<std::unique_ptr<RtuTransport>> create(const ModbusSerialSettings& settings);
  ~RtuTransport() override;

  /// Opens the line. Errors: the line cannot be used at present, with the reason.
  Result<> open();
  void close();

  /// Descriptor of the open line, non-blocking, for reading.
  int descriptor() const { return line_; }

  /// The bytes sent since the last call: the answer to the newest request; empty: no answer.
  std::vector<std::uint8_t> take_sent() { return std::exchange(sent_, {}); }

  /// Always true, because RtuFramer drops requests for other units.
  bool is_ours(std::span<const std::uint8_t> /*request*/) const override { return true; }
  /// Sends an exception, but not for broadcasts.
  bool refuse(std::span<const std::uint8_t> request, Exception exception) override;
  bool send(std::span<const std::uint8_t> request, std::span<const std::uint8_t> pdu) override;

 private:
  RtuTransport(Context context, std::string device)
      : Transport(std::move(context), kChecksum), device_(std::move(device)) {}

  bool deliver() override;

  static constexpr std::size_t kChecksum = 2;
  const std::string device_;
  int line_ = -1;                ///< libmodbus closes it
  hal::FileDescriptor encoded_;  ///< read end of the pipe
  hal::FileDescriptor encoder_;  ///< write end of the pipe, used by libmodbus
  std::vector<std::uint8_t> sent_;
};

}  // namespace orbwatch::app::modbus
