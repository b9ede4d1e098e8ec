// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/model/sink/recorded_events.h"
#include "app/ports/recorder/events/event_folder.h"
#include "app/ports/recorder/events/event_pictures.h"

namespace orbwatch::app::recorder {

/// The events of a recorder that may be recording. Thread-safe: it reads the folder anew each time.
class EventArchive final : public RecordedEvents {
 public:
  explicit EventArchive(const std::filesystem::path& recordings) : folder_(recordings) {}

  Result<std::vector<RecordedEvent>> list() const override;
  Result<std::filesystem::path> recording(std::string_view event) const override;
  Result<std::filesystem::path> picture(std::string_view event) const override;
  Result<std::vector<RecordedFrames>> frames(std::string_view event) override;
  Result<std::string> frame(std::string_view event, std::string_view camera,
                            std::size_t frame) override;
  /// Error also: it is being recorded.
  Result<> set_pinned(std::string_view event, bool is_pinned) override;
  /// Error also: it is being recorded.
  Result<> remove(std::string_view event) override;

 private:
  Result<StoredEvent> finished(std::string_view event) const;

  const EventFolder folder_;
  EventPictures pictures_;
};

}  // namespace orbwatch::app::recorder
