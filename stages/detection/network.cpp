// Runs one network with oneDNN, and reads its outputs.
#include "stages/detection/network.h"

#include <algorithm>
#include <cmath>
#include <oneapi/dnnl/dnnl.hpp>
#include <unordered_map>
#include <vector>

#include "core/parallel/parallel.h"
#include "observe/detection.h"
#include "stages/detection/network_graph.h"
#include "stages/detection/weights.h"

extern "C" void omp_set_num_threads(int);  // of libgomp, with which Debian's oneDNN is built

namespace barehand {
namespace {

// Values lie in memory in blocks of eight channels, [block][row][column][channel], as AVX2 prefers them. The channels
// of the last block that do not exist are zero.
constexpr int kBlock = 8;
constexpr auto kBlocked = dnnl::memory::format_tag::nChw8c;
constexpr auto kFloat = dnnl::memory::data_type::f32;

// A convolution with at least this many multiplications is computed in two halves of its output channels, which two
// cores may compute at once. A smaller one takes less time than waking the other core is worth.
constexpr double kLeastToShare = 4e6;

int blocks(int channels) { return (channels + kBlock - 1) / kBlock; }

bool all_finite(const std::vector<float>& values) {
  return std::ranges::all_of(values, [](float x) { return std::isfinite(x); });
}

/// Whether a network has the inputs and outputs of `shape` (docs/nets.md).
bool has_shape(const NetworkGraph& graph, const NetworkShape& shape) {
  const auto is = [&](const char* output, int channels, int step) {
    const auto found = graph.outputs.find(output);
    return found != graph.outputs.end() &&
           graph.values[found->second] == NetworkGraph::Shape{channels, shape.height / step, shape.width / step};
  };
  const auto is_number = [&](const char* output) {
    const auto found = graph.numbers.find(output);
    return found != graph.numbers.end() && found->second.input != 0;
  };
  return graph.values[0] == NetworkGraph::Shape{2, shape.height, shape.width} && is("j", shape.maps, 4) &&
         is("seg", kSurfaceLabelCount, 2) && is_number("side") && (!shape.tells_hands || is_number("hand"));
}

/// Whether values can be joined in blocks: only the last part of a join may end within a block.
bool joins_blocks(const NetworkGraph& graph) {
  return std::ranges::all_of(graph.steps, [&](const auto& step) {
    const auto* join = std::get_if<NetworkGraph::Join>(&step);
    return !join || (std::ranges::count(join->inputs, 0) == 0 &&
                     std::all_of(join->inputs.begin(), join->inputs.end() - 1,
                                 [&](int input) { return graph.values[input].channels % kBlock == 0; }));
  });
}

/// oneDNN must not start threads of its own, in addition to Workers. The number is a property of the calling thread.
void use_one_thread() { omp_set_num_threads(1); }

}  // namespace

struct Network::Net {
  explicit Net(NetworkGraph graph);
  void run(Workers& workers);
  /// An output in planes, one after the other.
  void read(const std::string& output, std::vector<float>& planes) const;
  /// An output that is a single number.
  float number(const std::string& output) const;

  NetworkGraph graph;
  dnnl::engine engine{dnnl::engine::kind::cpu, 0};
  std::vector<dnnl::memory> values;  // the input in planes, the others in blocks

  // Some of the output channels of one convolution.
  struct Part {
    dnnl::convolution_forward primitive;
    std::unordered_map<int, dnnl::memory> arguments;
    dnnl::stream stream;
  };
  std::vector<std::vector<Part>> convolutions;  // in the order of the graph's steps
  std::vector<float> map, label;                // the outputs of the last run

 private:
  std::vector<Part> prepare(const NetworkGraph::Convolution& step);
  // The output channels from `first` on, `count` of them; `first` must begin a block.
  Part prepare(const NetworkGraph::Convolution& step, int first, int count);
  // The channels of a value from `first` on, in the same memory.
  dnnl::memory channels(int value, int first, int count);
  void join(const NetworkGraph::Join& step);
  float* data(int value) const { return static_cast<float*>(values[value].get_data_handle()); }
};

Network::Net::Net(NetworkGraph read) : graph(std::move(read)) {
  // Allocate all values.
  for (std::size_t i = 0; i < graph.values.size(); ++i) {
    const auto& [channels, height, width] = graph.values[i];
    const dnnl::memory::dims sizes = {1, channels, height, width};
    values.emplace_back(dnnl::memory::desc(sizes, kFloat, i == 0 ? dnnl::memory::format_tag::nchw : kBlocked), engine);
  }

  // Have the convolutions compiled. The library keeps the weights.
  for (auto& step : graph.steps)
    if (auto* convolution = std::get_if<NetworkGraph::Convolution>(&step)) {
      convolutions.push_back(prepare(*convolution));
      convolution->weights = {};
    }
}

std::vector<Network::Net::Part> Network::Net::prepare(const NetworkGraph::Convolution& step) {
  const NetworkGraph::Shape& out = graph.values[step.output];
  const double work = static_cast<double>(step.weights.size()) * out.height * out.width;
  const int half = work < kLeastToShare ? 0 : kBlock * (blocks(out.channels) / 2);
  std::vector<Part> parts;
  if (half > 0) parts.push_back(prepare(step, 0, half));
  parts.push_back(prepare(step, half, out.channels - half));
  return parts;
}

Network::Net::Part Network::Net::prepare(const NetworkGraph::Convolution& step, int first, int count) {
  using Memory = dnnl::memory;
  const Memory::dim inputs = graph.values[step.input].channels;
  const Memory::dims sizes = {count, inputs, step.kernel, step.kernel}, stride = {step.stride, step.stride},
                     pad = {step.pad, step.pad};
  Memory output = channels(step.output, first, count), addend;

  // The addend and the positive part are computed along with the convolution.
  dnnl::post_ops after;
  if (step.addend >= 0) {
    addend = channels(step.addend, first, count);
    after.append_binary(dnnl::algorithm::binary_add, addend.get_desc());
  }
  if (step.relu) after.append_eltwise(1, dnnl::algorithm::eltwise_relu, 0, 0);
  dnnl::primitive_attr attributes;
  attributes.set_post_ops(after);

  // Describe the convolution, and leave the order of the weights open.
  const Memory::desc bias({count}, kFloat, Memory::format_tag::x);
  const dnnl::convolution_forward::desc wanted(
      dnnl::prop_kind::forward_inference, dnnl::algorithm::convolution_direct, values[step.input].get_desc(),
      Memory::desc(sizes, kFloat, Memory::format_tag::any), bias, output.get_desc(), stride, pad, pad);
  const dnnl::convolution_forward::primitive_desc chosen(wanted, attributes, engine);

  // The library chooses the order of the weights.
  dnnl::stream stream(engine);
  Memory weights(chosen.weights_desc(), engine), biases(bias, engine);
  Memory ordered({sizes, kFloat, Memory::format_tag::oihw}, engine);
  const std::size_t of_channel = static_cast<std::size_t>(inputs) * step.kernel * step.kernel;
  std::copy_n(step.weights.begin() + first * of_channel, count * of_channel,
              static_cast<float*>(ordered.get_data_handle()));
  std::copy_n(step.bias.begin() + first, count, static_cast<float*>(biases.get_data_handle()));
  dnnl::reorder(ordered, weights).execute(stream, ordered, weights);
  stream.wait();

  // Bind the arguments of the convolution.
  Part part{dnnl::convolution_forward(chosen),
            {{DNNL_ARG_SRC, values[step.input]},
             {DNNL_ARG_WEIGHTS, weights},
             {DNNL_ARG_BIAS, biases},
             {DNNL_ARG_DST, output}},
            stream};
  if (step.addend >= 0) part.arguments.emplace(DNNL_ARG_ATTR_MULTIPLE_POST_OP(0) | DNNL_ARG_SRC_1, addend);
  return part;
}

dnnl::memory Network::Net::channels(int value, int first, int count) {
  const auto& [all, height, width] = graph.values[value];
  return {{{1, count, height, width}, kFloat, kBlocked}, engine, data(value) + first * height * width};
}

void Network::Net::join(const NetworkGraph::Join& step) {
  const NetworkGraph::Shape& out = graph.values[step.output];
  float* to = data(step.output);
  for (const int input : step.inputs) {
    const NetworkGraph::Shape& in = graph.values[input];
    const float* from = data(input);
    for (int b = 0; b < blocks(in.channels); ++b, from += kBlock * in.height * in.width)
      for (int y = 0; y < out.height; ++y) {
        const float* row = from + kBlock * in.width * (y * in.height / out.height);
        for (int x = 0; x < out.width; ++x, to += kBlock)
          std::copy_n(row + kBlock * (x * in.width / out.width), kBlock, to);
      }
  }
}

void Network::Net::run(Workers& workers) {
  auto convolution = convolutions.begin();
  for (const auto& step : graph.steps) {
    if (const auto* joined = std::get_if<NetworkGraph::Join>(&step)) {
      join(*joined);
      continue;
    }
    std::vector<Part>& parts = *convolution++;
    workers.for_each_index(static_cast<int>(parts.size()), [&](int i) {
      use_one_thread();
      parts[i].primitive.execute(parts[i].stream, parts[i].arguments);
      parts[i].stream.wait();
    });
  }
}

void Network::Net::read(const std::string& output, std::vector<float>& planes) const {
  const int value = graph.outputs.at(output);
  const auto& [channels, height, width] = graph.values[value];
  const int cells = height * width;
  const float* from = data(value);
  planes.resize(static_cast<std::size_t>(channels) * cells);
  for (int c = 0; c < channels; ++c)
    for (int i = 0; i < cells; ++i) planes[c * cells + i] = from[kBlock * (c / kBlock * cells + i) + c % kBlock];
}

float Network::Net::number(const std::string& output) const {
  const NetworkGraph::WeightedMean& mean = graph.numbers.at(output);
  const int cells = graph.values[mean.input].height * graph.values[mean.input].width;
  const float* from = data(mean.input);
  float sum = mean.bias;
  for (int c = 0; c < static_cast<int>(mean.weights.size()); ++c) {
    float of_channel = 0;
    for (int i = 0; i < cells; ++i) of_channel += from[kBlock * (c / kBlock * cells + i) + c % kBlock];
    sum += mean.weights[c] * of_channel / static_cast<float>(cells);
  }
  return sum;
}

Network::Network(std::unique_ptr<Net> net, std::string name, const NetworkShape& shape)
    : net_(std::move(net)), name_(std::move(name)), shape_(shape) {}
Network::Network(Network&&) noexcept = default;
Network& Network::operator=(Network&&) noexcept = default;
Network::~Network() = default;

Result<Network> Network::load(const std::string& bytes, const std::string& name, const NetworkShape& shape) {
  auto graph = read_onnx(bytes, name);
  if (!graph) return tl::unexpected(graph.error());
  if (!has_shape(*graph, shape)) return fail("is a network with other inputs or outputs", name, kNetworkRemedy);
  if (!joins_blocks(*graph))
    return fail("is a network with widths that are no multiples of eight", name, kNetworkRemedy);

  // Restrict oneDNN to AVX2: wider registers are not faster here, and results are then the same on processors with and
  // without them.
  static_cast<void>(dnnl::set_max_cpu_isa(dnnl::cpu_isa::avx2));
  use_one_thread();
  try {
    Network network(std::make_unique<Net>(std::move(*graph)), name, shape);

    // A first run shows whether the outputs are finite.
    NetworkInput nothing;
    nothing.depth.reset(shape.width, shape.height, 1.f);
    nothing.valid.reset(shape.width, shape.height, 0.f);
    Workers alone(1);
    if (const auto output = network.run(nothing, alone); !output) return tl::unexpected(output.error());
    return network;
  } catch (const std::exception& error) {
    return fail(std::string("is a network that cannot be run: ") + error.what(), name, kNetworkRemedy);
  }
}

Result<NetworkOutput> Network::run(const NetworkInput& input, Workers& workers) {
  float* in = static_cast<float*>(net_->values[0].get_data_handle());
  std::copy_n(input.valid.data(), input.valid.size(), std::copy_n(input.depth.data(), input.depth.size(), in));
  try {
    net_->run(workers);
  } catch (const std::exception& error) {
    return fail(std::string("cannot be run: ") + error.what(), name_, kNetworkRemedy);
  }

  net_->read("j", net_->map);
  net_->read("seg", net_->label);
  const float side = net_->number("side"), hand = shape_.tells_hands ? net_->number("hand") : 0;
  if (!all_finite(net_->map) || !all_finite(net_->label) || !std::isfinite(side) || !std::isfinite(hand))
    return fail("gives values that are not finite", name_, kNetworkRemedy);
  return NetworkOutput{shape_.maps,
                       shape_.width / 4,
                       shape_.height / 4,
                       net_->map.data(),
                       shape_.width / 2,
                       shape_.height / 2,
                       net_->label.data(),
                       side,
                       hand};
}

}  // namespace barehand
