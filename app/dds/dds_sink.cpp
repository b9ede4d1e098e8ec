#include "app/dds/dds_sink.h"

#include <algorithm>

#include "app/dds/dds_log.h"
#include "app/dds/topic_names.h"

namespace orbwatch::app {

DdsSink::Channel::Channel(const std::string& prefix, const std::string& view_name)
    : name(view_name),
      colour(image_topic(prefix, view_name)),
      radiometric(radiometric_topic(prefix, view_name)) {}

DdsSink::DdsSink(DdsSettings settings, std::vector<std::string> view_names)
    : settings_(std::move(settings)),
      view_names_(std::move(view_names)),
      selected_(image_topic(settings_.prefix, kSelectedView)),
      state_(orbwatch_msgs_msg_dds__ProcessState__desc, process_state_topic(settings_.prefix)),
      composer_(view_names_) {
  for (const auto& name : view_names_) {
    channels_.push_back(std::make_unique<Channel>(settings_.prefix, name));
  }
}

DdsSink::~DdsSink() { stop(); }

Result<> DdsSink::start() {
  if (!settings_.enabled || thread_.joinable()) return {};
  limit_dds_log();
  const auto opened = check_names().and_then([this] { return open(); });
  if (!opened) {
    close();
    return opened;
  }
  running_ = true;
  thread_ = std::thread([this] { run(); });
  return {};
}

void DdsSink::stop() {
  running_ = false;
  wake_.put({});
  if (thread_.joinable()) thread_.join();
  close();
}

Result<> DdsSink::check_names() const {
  if (const auto checked = check_topic_path(settings_.prefix, "prefix"); !checked) return checked;
  for (auto name = view_names_.begin(); name != view_names_.end(); ++name) {
    if (const auto checked = check_topic_part(*name, "view name"); !checked) return checked;
    if (*name == kSelectedView || std::find(view_names_.begin(), name, *name) != name) {
      return fail("DDS: view name \"" + *name + "\" is taken, each needs one of its own");
    }
  }
  return {};
}

Result<> DdsSink::open() {
  auto participant = Participant::join(settings_.domain);
  if (!participant) return tl::unexpected(participant.error());
  participant_ = std::move(*participant);
  for (const auto& channel : channels_) {
    if (const auto opened = channel->colour.open(participant_.entity()); !opened) return opened;
  }
  if (const auto opened = selected_.open(participant_.entity()); !opened) return opened;
  return state_.open(participant_.entity(), state_qos());
}

void DdsSink::close() {
  for (const auto& channel : channels_) {
    channel->colour.close();
    channel->radiometric.close();
    channel->mailbox.try_take();  // gives the view back to its pool
  }
  status_.try_take();
  selected_.close();
  state_.close();
  participant_.leave();
}

const TimeMessage& DdsSink::utc(hal::TimePoint stamp) {
  if (stamp != stamp_) {
    stamp_ = stamp;
    utc_ = to_message(hal::to_utc(stamp));
  }
  return utc_;
}

void DdsSink::accept(const ViewPtr& view) {
  if (!running_) return;
  if (view->index >= channels_.size()) {
    ++unknown_views_;
    return;
  }
  channels_[view->index]->mailbox.put({view, utc(view->stamp)});
  wake_.put({});
}

void DdsSink::accept(const Status& status) {
  if (!running_) return;
  status_.put({status, status.frame_set == 0 ? TimeMessage{} : utc(status.stamp)});
  wake_.put({});
}

void DdsSink::run() {
  while (wake_.take() && running_) {
    // The status first: it follows its views, so its selection is already theirs.
    const auto status = status_.try_take();
    if (status) selected_view_ = status->status.selected_view;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      if (const auto stamped = channels_[i]->mailbox.try_take()) {
        publish(*channels_[i], i, *stamped);
      }
    }
    if (status) state_.write(&composer_.compose(status->status, status->stamp));
  }
}

void DdsSink::publish(Channel& channel, std::size_t index, const StampedView& stamped) {
  const View& view = *stamped.view;
  const ImagePlane colour = colour_plane(view.colour);
  channel.colour.publish(colour, channel.name, stamped.stamp);
  if (index == selected_view_) selected_.publish(colour, channel.name, stamped.stamp);
  if (view.radiometric.empty()) return;
  if (channel.radiometric.open(participant_.entity())) {
    channel.radiometric.publish(radiometric_plane(view.radiometric), channel.name, stamped.stamp);
  }
}

DdsStatistics DdsSink::statistics() const {
  DdsStatistics statistics;
  for (const auto& channel : channels_) {
    statistics.topics.push_back(channel->colour.statistics());
    statistics.topics.push_back(channel->radiometric.statistics());
    statistics.dropped_views.push_back(channel->mailbox.drops());
  }
  statistics.topics.push_back(selected_.statistics());
  statistics.topics.push_back(state_.statistics());
  statistics.dropped_states = status_.drops();
  statistics.unknown_views = unknown_views_;
  return statistics;
}

}  // namespace orbwatch::app
