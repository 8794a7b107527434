#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/error.h"

namespace barehand {

/// A convolutional network as a list of steps in the order in which they can be taken. Steps exchange values: stacks of
/// planes (channels) of equal size, which are numbered; value 0 is the network's input.
struct NetworkGraph {
  struct Shape {
    int channels = 0, height = 0, width = 0;
    bool operator==(const Shape&) const = default;
  };

  /// output = convolution of `input` + bias, + `addend` if that is not negative, and its positive part if `relu`.
  struct Convolution {
    int input = 0, output = 0, addend = -1;
    bool relu = false;
    int kernel = 1, stride = 1, pad = 0;  ///< the same for rows and columns
    std::vector<float> weights, bias;     ///< weights: [output channel][input channel][row][column]
  };
  /// output = the channels of all inputs, enlarged to the output's size by repeating the nearest pixels above and left.
  struct Join {
    std::vector<int> inputs;
    int output = 0;
  };
  /// A number: weights * (means of the input's channels) + bias.
  struct WeightedMean {
    int input = 0;
    std::vector<float> weights;
    float bias = 0;
  };

  std::vector<Shape> values;
  std::vector<std::variant<Convolution, Join>> steps;
  std::map<std::string, int> outputs;           ///< numbers of the values that are the network's outputs, by name
  std::map<std::string, WeightedMean> numbers;  ///< outputs that are single numbers
};

/// Reads the bytes of an ONNX file; `name` is for error messages. Errors: it is not an ONNX file, or damaged; it
/// contains an operator that networks of tools/training do not have; weights are not finite.
Result<NetworkGraph> read_onnx(const std::string& bytes, const std::string& name);

}  // namespace barehand
