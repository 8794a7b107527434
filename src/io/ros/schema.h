#pragma once

#include <array>
#include <concepts>
#include <string>
#include <type_traits>
#include <vector>

#include "io/ros/ros_types.h"

namespace barehand::ros {

template <class T>
concept Message = requires {
  T::kType;
};

/// Writes the schema of a message in the encoding ros2msg: the text of its .msg file, one line per field, followed by
/// the texts of the message types that it contains.
class SchemaText {
 public:
  template <Message M>
  static std::string of() {
    SchemaText root;
    root.describe<M>();
    std::string text = root.text_;
    for (std::size_t i = 0; i < root.inner_.size(); ++i)
      text += std::string(80, '=') + "\nMSG: " + root.inner_[i].type + "\n" + root.inner_[i].text;
    return text;
  }

  template <class T>
  void operator()(const char* name, const T&) {
    text_ += type_name<T>() + " " + name + "\n";
  }

 private:
  struct Inner {
    std::string type, text;
  };

  template <Message M>
  void describe() {
    const M message;
    M::fields(*this, message);
  }

  template <class T>
  std::string type_name() {
    if constexpr (Message<T>) {
      add_inner<T>();
      return T::kType;
    } else {
      return primitive(T{});
    }
  }
  template <class T>
  requires requires(T t) { t.emplace_back(); } &&(!std::same_as<T, std::string>)std::string type_name() {
    return type_name<typename T::value_type>() + "[]";
  }
  template <class T>
  requires(std::tuple_size<T>::value > 0) std::string type_name() {
    return type_name<typename T::value_type>() + "[" + std::to_string(std::tuple_size_v<T>) + "]";
  }

  /// Adds the text of a contained type. Each type is added once, in the order of first use.
  template <Message M>
  void add_inner() {
    for (const Inner& known : inner_)
      if (known.type == M::kType) return;
    const std::size_t at = inner_.size();
    inner_.push_back({M::kType, ""});
    std::string outer;
    outer.swap(text_);
    describe<M>();
    inner_[at].text.swap(text_);
    text_.swap(outer);
  }

  static std::string primitive(bool) { return "bool"; }
  static std::string primitive(std::byte) { return "byte"; }
  static std::string primitive(std::uint8_t) { return "uint8"; }
  static std::string primitive(std::int32_t) { return "int32"; }
  static std::string primitive(std::uint32_t) { return "uint32"; }
  static std::string primitive(float) { return "float32"; }
  static std::string primitive(double) { return "float64"; }
  static std::string primitive(const std::string&) { return "string"; }

  std::string text_;
  std::vector<Inner> inner_;
};

/// The name of a message type in files and viewers, such as "sensor_msgs/msg/Image".
template <Message M>
std::string schema_name() {
  std::string name = M::kType;
  return name.insert(name.find('/'), "/msg");
}

}  // namespace barehand::ros
