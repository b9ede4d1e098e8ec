// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/web/streams/feed.h"
#include "app/ports/web/streams/parts.h"
#include "app/ports/web/streams/stream_counts.h"

namespace orbwatch::app::web {

/// Several feeds over one connection, in turn, because browsers limit connections per host. Each
/// message begins with a line of JSON that states its feed, its number, UTC stamp, age when sent,
/// the view's aim (see SentAim), the sides of its full picture, to which all coordinates refer, and
/// the number of bytes that follow the line:
///   {"kind":"view","name":"front","number":7,"stamp":"...","age_ms":31.5,"aim":{...},"width":640,
///    "height":480,"bytes":20480}
/// The feed of kind "status" has no name and the JSON of /api/v1/status.
class LiveStream final : public Stream {
 public:
  static constexpr std::string_view kType = "application/octet-stream";

  struct Source {
    std::string name;  ///< name of the view; empty: the status
    std::shared_ptr<Feed> feed;
  };

  /// `counts` outlives the stream.
  LiveStream(std::vector<Source> sources, StreamCounts& counts);

  void on_data(std::function<void()> wake) override;
  std::size_t read(std::span<char> out) override;

 private:
  bool begin_next();
  void begin(const Source& source, Item item);

  const std::vector<Source> sources_;
  StreamCounts& counts_;
  std::vector<std::unique_ptr<Feed::Reader>> readers_;  ///< readers by source
  std::size_t turn_ = 0;                                ///< index of the source that is read first
  std::string head_;                                    ///< head of the message being sent
  Bytes body_;
  Parts parts_;
};

}  // namespace orbwatch::app::web
