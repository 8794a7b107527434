// Runs one network with OpenCV, and reads its outputs.
#include "stages/detection/network.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <vector>

#include "observe/detection.h"

namespace barehand {
namespace {

constexpr const char* kRemedy = "use the networks that came with this version of Barehand";

/// Silences OpenCV while it lives: OpenCV would log every exception, which is reported by the returned error anyway.
class QuietOpenCv {
 public:
  QuietOpenCv() : level_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~QuietOpenCv() { cv::utils::logging::setLogLevel(level_); }
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  cv::utils::logging::LogLevel level_;
};

bool has_shape(const cv::Mat& blob, int planes, int height, int width) {
  return blob.dims == 4 && blob.type() == CV_32F && blob.size[0] == 1 && blob.size[1] == planes &&
         blob.size[2] == height && blob.size[3] == width && blob.isContinuous();
}

bool all_finite(const cv::Mat& blob) {
  const float* values = blob.ptr<float>();
  return std::all_of(values, values + blob.total(), [](float x) { return std::isfinite(x); });
}

}  // namespace

struct Network::Net {
  cv::dnn::Net net;
  cv::Mat input;
  std::vector<cv::Mat> outputs;
  const std::vector<cv::String> names = {"j", "seg", "side"};
};

Network::Network(std::unique_ptr<Net> net, std::string name, const NetworkShape& shape)
    : net_(std::move(net)), name_(std::move(name)), shape_(shape) {}
Network::Network(Network&&) noexcept = default;
Network& Network::operator=(Network&&) noexcept = default;
Network::~Network() = default;

Result<Network> Network::load(const std::string& bytes, const std::string& name, const NetworkShape& shape) {
  const QuietOpenCv quiet;
  auto net = std::make_unique<Net>();
  try {
    net->net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    net->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net->net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  } catch (const std::exception&) {
    return fail("is not a network that OpenCV can read", name, kRemedy);
  }
  Network network(std::move(net), name, shape);

  // A first run shows whether the shapes are right and the outputs are finite.
  NetworkInput nothing;
  nothing.depth.reset(shape.width, shape.height, 1.f);
  nothing.valid.reset(shape.width, shape.height, 0.f);
  if (const auto output = network.run(nothing); !output) return tl::unexpected(output.error());
  return network;
}

Result<NetworkOutput> Network::run(const NetworkInput& input) {
  const std::array<int, 4> sizes = {1, 2, shape_.height, shape_.width};
  net_->input.create(4, sizes.data(), CV_32F);
  std::copy_n(input.depth.data(), input.depth.size(), net_->input.ptr<float>(0, 0));
  std::copy_n(input.valid.data(), input.valid.size(), net_->input.ptr<float>(0, 1));
  try {
    net_->net.setInput(net_->input);
    net_->net.forward(net_->outputs, net_->names);
  } catch (const std::exception&) {
    return fail("is a network with other inputs or outputs", name_, kRemedy);
  }

  const cv::Mat &map = net_->outputs[0], &label = net_->outputs[1], &side = net_->outputs[2];
  NetworkOutput result{shape_.maps,      shape_.width / 4,  shape_.height / 4,  map.ptr<float>(),
                       shape_.width / 2, shape_.height / 2, label.ptr<float>(), 0};
  if (!has_shape(map, result.maps, result.map_height, result.map_width) ||
      !has_shape(label, kSurfaceLabelCount, result.label_height, result.label_width) || side.total() != 1)
    return fail("is a network with other inputs or outputs", name_, kRemedy);
  if (!all_finite(map) || !all_finite(label) || !all_finite(side))
    return fail("gives values that are not finite", name_, kRemedy);
  result.side = *side.ptr<float>();
  return result;
}

}  // namespace barehand
