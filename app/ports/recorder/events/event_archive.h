// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "app/model/sink/recorded_events.h"
#include "app/ports/recorder/events/event_folder.h"
#include "app/ports/recorder/events/event_index.h"
#include "app/ports/recorder/events/event_pictures.h"
#include "app/ports/recorder/events/event_signals.h"

namespace orbwatch::app::recorder {

/// The events of a recorder that may be recording. A list costs what has changed since the one
/// before, see EventIndex. Thread-safe.
class EventArchive final : public RecordedEvents {
 public:
  explicit EventArchive(const std::filesystem::path& recordings)
      : folder_(recordings), index_(recordings) {}

  Result<std::shared_ptr<const std::vector<RecordedEvent>>> list() override;
  Result<std::filesystem::path> recording(std::string_view event) const override;
  Result<std::filesystem::path> picture(std::string_view event) const override;
  Result<std::vector<RecordedFrames>> frames(std::string_view event) override;
  Result<std::string> frame(std::string_view event, std::string_view camera,
                            std::size_t frame) override;
  Result<std::vector<RecordedSignal>> signals(std::string_view event) override;
  Result<std::vector<RecordedRecipeChange>> recipes(std::string_view event) override;
  Result<RecordedCourse> course(std::string_view event, const std::string& region,
                                const std::string& figure) override;
  /// Error also: it is being recorded, or was not finished.
  Result<> set_pinned(std::string_view event, bool is_pinned) override;
  /// Error also: it is being recorded.
  Result<> remove(std::string_view event) override;

 private:
  Result<StoredEvent> finished(std::string_view event) const;

  const EventFolder folder_;
  EventPictures pictures_;
  EventSignals signals_;
  std::mutex mutex_;
  EventIndex index_;                 ///< guarded by mutex_
  std::vector<StoredEvent> stored_;  ///< as in listed_; guarded by mutex_
  std::shared_ptr<const std::vector<RecordedEvent>> listed_ =
      std::make_shared<std::vector<RecordedEvent>>();  ///< guarded by mutex_
};

}  // namespace orbwatch::app::recorder
