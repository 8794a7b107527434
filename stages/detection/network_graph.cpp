#include "stages/detection/network_graph.h"

#include <onnx/onnx_pb.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "stages/detection/weights.h"

namespace barehand {
namespace {

/// Thrown for a feature of the file that this program does not support. Lookups of unknown names throw
/// std::out_of_range.
struct Unsupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};
void require(bool supported, const std::string& what) {
  if (!supported) throw Unsupported(what);
}

template <typename T>
std::vector<T> numbers_of(const onnx::TensorProto& tensor) {
  std::size_t count = 1;
  for (const std::int64_t size : tensor.dims()) {
    require(size >= 0 && size < (1 << 24), "a tensor of size " + std::to_string(size));
    count *= static_cast<std::size_t>(size);
    require(count < (1 << 28), "a tensor that is too large");
  }
  require(tensor.raw_data().size() == count * sizeof(T), "a tensor whose size and data differ");
  std::vector<T> numbers(count);
  if (count > 0) std::memcpy(numbers.data(), tensor.raw_data().data(), tensor.raw_data().size());
  return numbers;
}

/// Turns the nodes of an ONNX graph into steps, one after the other.
class OnnxReader {
 public:
  explicit OnnxReader(const onnx::GraphProto& graph) : onnx_(graph) {}

  NetworkGraph read() {
    for (const onnx::TensorProto& tensor : onnx_.initializer()) constants_[tensor.name()] = &tensor;
    for (const onnx::NodeProto& node : onnx_.node())
      for (const std::string& input : node.input()) ++uses_[input];
    for (const onnx::ValueInfoProto& output : onnx_.output()) ++uses_[output.name()];
    require(onnx_.input_size() == 1, std::to_string(onnx_.input_size()) + " inputs");
    const auto& sizes = onnx_.input(0).type().tensor_type().shape();
    require(sizes.dim_size() == 4 && sizes.dim(0).dim_value() == 1, "an input that is not one image");
    values_[onnx_.input(0).name()] = add_value({size(sizes.dim(1)), size(sizes.dim(2)), size(sizes.dim(3))});

    for (const onnx::NodeProto& node : onnx_.node()) read(node);
    for (const onnx::ValueInfoProto& output : onnx_.output())
      if (!graph_.numbers.contains(output.name())) graph_.outputs[output.name()] = values_.at(output.name());
    return std::move(graph_);
  }

 private:
  static int size(const onnx::TensorShapeProto::Dimension& dimension) {
    require(dimension.dim_value() > 0 && dimension.dim_value() < 10000, "an input of unknown size");
    return static_cast<int>(dimension.dim_value());
  }
  int add_value(const NetworkGraph::Shape& shape) {
    graph_.values.push_back(shape);
    return static_cast<int>(graph_.values.size()) - 1;
  }
  const NetworkGraph::Shape& shape_of(const std::string& name) const { return graph_.values[values_.at(name)]; }
  std::vector<float> floats(const std::string& name) const {
    auto numbers = numbers_of<float>(*constants_.at(name));
    require(std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); }), "weights that are not finite");
    return numbers;
  }

  void read(const onnx::NodeProto& node) {
    const std::string& type = node.op_type();
    require(node.output_size() == 1, type + " with several outputs");
    require(node.input_size() >= (type == "Constant" ? 0 : type == "Slice" ? 3 : 1), type + " without inputs");

    // Read the node by its type; a node that is not a layer must compute a size.
    if (type == "Conv")
      add_convolution(node);
    else if (type == "Relu" || type == "Add")
      extend_convolution(node);
    else if (type == "Resize")
      enlarge(node);
    else if (type == "Concat" && !integers_.contains(node.input(0)))
      join(node);
    else if (type == "ReduceMean")
      means_[node.output(0)] = values_.at(node.input(0));
    else if (type == "Gemm")
      add_number(node);
    else
      compute_size(node);
  }

  static std::vector<std::int64_t> attribute(const onnx::NodeProto& node, const std::string& name) {
    for (const onnx::AttributeProto& found : node.attribute())
      if (found.name() == name) return {found.ints().begin(), found.ints().end()};
    return {};
  }

  void add_convolution(const onnx::NodeProto& node) {
    // Only square kernels, equal strides and equal borders are supported.
    NetworkGraph::Convolution step;
    const auto kernel = attribute(node, "kernel_shape"), strides = attribute(node, "strides"),
               pads = attribute(node, "pads"), dilations = attribute(node, "dilations");
    const auto equal = [](const std::vector<std::int64_t>& v, std::size_t n) {
      return v.size() == n && std::ranges::count(v, v[0]) == static_cast<std::ptrdiff_t>(n) && v[0] >= 0 && v[0] < 100;
    };
    require(equal(kernel, 2) && equal(strides, 2) && equal(pads, 4) && kernel[0] > 0 && strides[0] > 0 &&
                std::ranges::all_of(dilations, [](std::int64_t d) { return d == 1; }),
            "a convolution with unequal sides");

    step.kernel = static_cast<int>(kernel[0]);
    step.stride = static_cast<int>(strides[0]);
    step.pad = static_cast<int>(pads[0]);

    // Read the weights and the bias.
    require(node.input_size() == 3, "a convolution without bias");
    step.input = values_.at(node.input(0));
    step.weights = floats(node.input(1));
    step.bias = floats(node.input(2));
    const NetworkGraph::Shape in = graph_.values[step.input];
    const int channels = static_cast<int>(step.bias.size());
    require(step.weights.size() == step.bias.size() * in.channels * step.kernel * step.kernel, "a grouped convolution");

    // Add the output, whose size follows from kernel, stride and border.
    const auto reduced = [&](int n) { return (n + 2 * step.pad - step.kernel) / step.stride + 1; };
    require(std::min(in.height, in.width) + 2 * step.pad >= step.kernel, "a convolution larger than its input");
    step.output = add_value({channels, reduced(in.height), reduced(in.width)});
    values_[node.output(0)] = step.output;
    convolutions_[step.output] = static_cast<int>(graph_.steps.size());
    graph_.steps.push_back(std::move(step));
  }

  /// Merges an addition or a ReLU into the convolution before it.
  void extend_convolution(const onnx::NodeProto& node) {
    const bool add = node.op_type() == "Add";
    require(node.input_size() == (add ? 2 : 1), node.op_type() + " of other inputs");
    for (int i = 0; i < node.input_size(); ++i) {
      // The convolution's own result must have no other use, and the addend must be computed before it.
      const int value = values_.at(node.input(i));
      const auto found = convolutions_.find(value);
      if (found == convolutions_.end() || uses_[node.input(i)] != 1) continue;
      auto& step = std::get<NetworkGraph::Convolution>(graph_.steps[found->second]);
      const int addend = add ? values_.at(node.input(1 - i)) : step.addend;
      if (step.relu || addend >= value) continue;
      if (add && (step.addend >= 0 || graph_.values[addend] != graph_.values[value])) continue;

      step.addend = addend;
      step.relu = !add;
      values_[node.output(0)] = value;
      return;
    }
    throw Unsupported(node.op_type() + " that does not follow a convolution");
  }

  void enlarge(const onnx::NodeProto& node) {
    for (const onnx::AttributeProto& found : node.attribute()) {
      if (found.name() == "mode") require(found.s() == "nearest", "Resize by " + found.s());
      if (found.name() == "coordinate_transformation_mode")
        require(found.s() == "asymmetric", "Resize with " + found.s());
      if (found.name() == "nearest_mode") require(found.s() == "floor", "Resize with " + found.s());
    }
    require(node.input_size() == 4, "Resize without sizes");
    const std::vector<std::int64_t>& sizes = integers_.at(node.input(3));
    require(sizes.size() == 4, "Resize of something that is not an image");
    enlarged_[node.output(0)] = {values_.at(node.input(0)), sizes[2], sizes[3]};
  }

  void join(const onnx::NodeProto& node) {
    NetworkGraph::Join step;
    NetworkGraph::Shape out;
    for (const std::string& name : node.input()) {
      // Resize has no step of its own: the join reads the input of Resize, and enlarges it to the size of its output.
      const auto found = enlarged_.find(name);
      const int value = found != enlarged_.end() ? found->second.value : values_.at(name);
      const NetworkGraph::Shape& in = graph_.values[value];
      const std::int64_t height = found != enlarged_.end() ? found->second.height : in.height,
                         width = found != enlarged_.end() ? found->second.width : in.width;
      if (step.inputs.empty()) out = {0, static_cast<int>(height), static_cast<int>(width)};

      // All planes must have the same size.
      require(height == out.height && width == out.width && height >= in.height && width >= in.width &&
                  height < 10000 && width < 10000,
              "Concat of planes of different sizes");
      out.channels += in.channels;
      step.inputs.push_back(value);
    }

    // Add the step to the graph.
    step.output = values_[node.output(0)] = add_value(out);
    graph_.steps.push_back(std::move(step));
  }

  void add_number(const onnx::NodeProto& node) {
    require(node.input_size() == 3, "Gemm without bias");
    NetworkGraph::WeightedMean number{means_.at(node.input(0)), floats(node.input(1)), 0};
    const std::vector<float> bias = floats(node.input(2));
    require(bias.size() == 1 && static_cast<int>(number.weights.size()) == graph_.values[number.input].channels,
            "Gemm with several results");
    number.bias = bias[0];
    graph_.numbers[node.output(0)] = std::move(number);
  }

  /// Evaluates the nodes that compute the sizes for Resize from the shapes of values.
  void compute_size(const onnx::NodeProto& node) {
    std::vector<std::int64_t>& out = integers_[node.output(0)];

    // Read a constant, or the shape of a value.
    if (node.op_type() == "Constant" && node.attribute_size() == 1) {
      const onnx::TensorProto& tensor = node.attribute(0).t();
      if (tensor.data_type() == onnx::TensorProto::INT64) out = numbers_of<std::int64_t>(tensor);
    } else if (node.op_type() == "Shape") {
      const NetworkGraph::Shape& shape = shape_of(node.input(0));
      out = {1, shape.channels, shape.height, shape.width};

      // Take a part of another result.
    } else if (node.op_type() == "Slice") {
      const auto& in = integers_.at(node.input(0));
      const auto end_of = [&](int i) {
        const auto& limits = integers_.at(node.input(i));
        require(limits.size() == 1 && limits[0] >= 0, "Slice from the end");
        return std::min<std::int64_t>(limits[0], static_cast<std::int64_t>(in.size()));
      };
      const std::int64_t first = end_of(1), last = end_of(2);
      if (first < last) out.assign(in.begin() + first, in.begin() + last);
    } else if (node.op_type() == "Concat") {
      // Concatenate the parts.
      for (const std::string& name : node.input()) {
        const std::vector<std::int64_t> part = integers_.at(name);
        out.insert(out.end(), part.begin(), part.end());
      }
    } else {
      throw Unsupported("the operator " + node.op_type());
    }
  }

  struct Enlarged {
    int value;
    std::int64_t height, width;
  };
  const onnx::GraphProto& onnx_;
  NetworkGraph graph_;
  std::map<std::string, const onnx::TensorProto*> constants_;
  std::map<std::string, int> values_, uses_, means_;           // indexed by the names in the file
  std::map<std::string, std::vector<std::int64_t>> integers_;  // small tensors of integers
  std::map<std::string, Enlarged> enlarged_;
  std::map<int, int> convolutions_;  // index of the step that computes a value
};

}  // namespace

Result<NetworkGraph> read_onnx(const std::string& bytes, const std::string& name) {
  onnx::ModelProto model;
  if (!model.ParseFromString(bytes) || model.graph().node_size() == 0)
    return fail("is not a network in an ONNX file", name, kNetworkRemedy);
  try {
    return OnnxReader(model.graph()).read();
  } catch (const Unsupported& unsupported) {
    return fail(std::string("is a network with ") + unsupported.what(), name, kNetworkRemedy);
  } catch (const std::exception&) {
    return fail("is a network whose parts do not fit together", name, kNetworkRemedy);
  }
}

}  // namespace barehand
