// SPDX-License-Identifier: BSD-3-Clause
// Panels: the driver's picture, and the table of sources.
#include <QHeaderView>
#include <QTimer>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <chrono>
#include <optional>
#include <string>

#include "driver_painter.h"
#include "panel_topic.h"
#include <rviz/panel.h>
#include <rviz/visualization_manager.h>

#include <pluginlib/class_list_macros.hpp>
#include <ros/node_handle.h>

#include "datmo_fusion/ros/display/driver_view.h"
#include "datmo_fusion/ros/display/source_table.h"

namespace datmo {

namespace {

/// s; older risks are not shown: a driver must not trust them.
constexpr double kFresh = 1.0;

/// ms, periods.
constexpr int kAgeCheck = 250;
constexpr int kTableUpdate = 1000;
constexpr int kTopicCheck = 1000;

double secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Callbacks run in the window's thread.
ros::NodeHandle windowNode(rviz::VisualizationManager& manager) {
  ros::NodeHandle node;
  node.setCallbackQueue(manager.getUpdateQueue());
  return node;
}

}  // namespace

/// The host from above, nearby road users, and the level of risk with its reason. In: the topics
/// with the keys "Risks Topic" and "Tracks Topic" in the configuration. A topic that cannot be
/// subscribed, or that is of another type, is reported in the picture and in the panel's tool tip.
class DriverPanel : public rviz::Panel {
 public:
  explicit DriverPanel(QWidget* parent = nullptr) : Panel(parent) {
    setMinimumSize(220, 260);
    auto* timer = new QTimer(this);
    connect(timer, &QTimer::timeout, this, [this] { update(); });
    timer->start(kAgeCheck);
    auto* topics = new QTimer(this);
    connect(topics, &QTimer::timeout, this, [this] { checkTopics(); });
    topics->start(kTopicCheck);
  }

  void onInitialize() override { subscribe(); }

  void load(const rviz::Config& config) override {
    Panel::load(config);
    risks_.load(config);
    tracks_.load(config);
    subscribe();
  }

  void save(rviz::Config config) const override {
    Panel::save(config);
    risks_.save(config);
    tracks_.save(config);
  }

 protected:
  void paintEvent(QPaintEvent* /*event*/) override {
    QPainter painter(this);
    const bool fresh = view_ && secondsNow() - received_at_ <= kFresh;
    paintDriverView(painter, size(), fresh ? &*view_ : nullptr, toolTip());
  }

 private:
  void subscribe() {
    if (!vis_manager_) {
      return;
    }
    view_.reset();
    last_tracks_.reset();
    ros::NodeHandle node = windowNode(*vis_manager_);
    // First, as a new configuration may exchange the two topics, and each has one type.
    risks_.unsubscribe();
    tracks_.unsubscribe();
    risks_.subscribe(node, [this](const RiskArrayConstPtr& message) { handleRisks(*message); });
    tracks_.subscribe(node, [this](const TrackArrayConstPtr& message) { last_tracks_ = message; });
    checkTopics();
  }

  void checkTopics() {
    const std::string risks = risks_.fault();
    const std::string tracks = tracks_.fault();
    const char* const separator = risks.empty() || tracks.empty() ? "" : "\n";
    setToolTip(QString::fromStdString(risks + separator + tracks));
  }

  void handleRisks(const RiskArray& risks) {
    view_ = driverViewOf(risks, last_tracks_.get());
    received_at_ = secondsNow();
    update();
  }

  PanelTopic<RiskArray> risks_{"Risks Topic", "/risks"};
  PanelTopic<TrackArray> tracks_{"Tracks Topic", "/tracks"};
  TrackArrayConstPtr last_tracks_;
  std::optional<DriverView> view_;
  double received_at_ = 0.0;  ///< s, when the risks were received
};

/// Each input of each stage: rate, age, latency, number of dropped messages and reasons, from
/// /diagnostics.
class SourcesPanel : public rviz::Panel {
 public:
  explicit SourcesPanel(QWidget* parent = nullptr) : Panel(parent), table_(new QTreeWidget(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(table_);
    table_->setRootIsDecorated(false);
    table_->setHeaderLabels({"stage", "input", "Hz", "age [s]", "latency [ms]", "takes [ms]",
                             "dropped", "why", "state"});
    table_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    auto* timer = new QTimer(this);
    connect(timer, &QTimer::timeout, this, [this] { fill(); });
    timer->start(kTableUpdate);
  }

  void onInitialize() override {
    diagnostics_ =
        windowNode(*vis_manager_)
            .subscribe("/diagnostics", kPanelQueue, &SourcesPanel::handleDiagnostics, this);
  }

 private:
  void handleDiagnostics(const diagnostic_msgs::DiagnosticArrayConstPtr& message) {
    sources_.update(*message, secondsNow());
  }

  void fill() {
    static const QColor kColors[] = {QColor(210, 240, 215), QColor(255, 236, 170),
                                     QColor(255, 190, 185), QColor(220, 220, 220)};
    const std::vector<SourceRow> rows = sources_.rows(secondsNow());
    while (table_->topLevelItemCount() > static_cast<int>(rows.size())) {
      delete table_->takeTopLevelItem(table_->topLevelItemCount() - 1);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto index = static_cast<int>(i);
      if (index >= table_->topLevelItemCount()) {
        table_->addTopLevelItem(new QTreeWidgetItem());
      }
      QTreeWidgetItem* item = table_->topLevelItem(index);
      const SourceRow& row = rows[i];
      int column = 0;
      for (const std::string* cell : {&row.stage, &row.input, &row.rate, &row.age, &row.latency,
                                      &row.time, &row.dropped, &row.why, &row.state}) {
        item->setText(column, QString::fromStdString(*cell));
        item->setBackground(column, kColors[std::min<std::size_t>(row.level, 3)]);
        item->setForeground(column, QColor(20, 20, 20));
        ++column;
      }
    }
  }

  QTreeWidget* table_;
  SourceTable sources_;
  ros::Subscriber diagnostics_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::DriverPanel, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(datmo::SourcesPanel, rviz::Panel)
