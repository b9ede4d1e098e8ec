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

/// Several feeds over one connection, by turns, because browsers open few connections to a host. Of
/// each message first a line of JSON that says whose it is, its number, UTC stamp, age when it is
/// sent, where the view looks (see Aim) and how many bytes follow the line:
///   {"kind":"view","name":"front","number":7,"stamp":"...","age_ms":31.5,"aim":{...},"bytes":20480}
/// The feed of kind "status" has no name and JSON as of /api/v1/status.
class LiveStream final : public Stream {
 public:
  static constexpr std::string_view kType = "application/octet-stream";

  struct Source {
    std::string name;  ///< of the view; empty: the status
    std::shared_ptr<Feed> feed;
  };

  /// `counts` outlives it.
  LiveStream(std::vector<Source> sources, StreamCounts& counts);

  void on_data(std::function<void()> wake) override;
  std::size_t read(std::span<char> out) override;

 private:
  bool begin_next();
  void begin(const Source& source, Item item);

  const std::vector<Source> sources_;
  StreamCounts& counts_;
  std::vector<std::unique_ptr<Feed::Reader>> readers_;  ///< by source
  std::size_t turn_ = 0;                                ///< the source that is asked first
  std::string head_;                                    ///< of the message that is being sent
  Bytes body_;
  Parts parts_;
};

}  // namespace orbwatch::app::web
