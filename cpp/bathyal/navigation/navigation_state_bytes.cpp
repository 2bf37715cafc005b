// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/navigation_state_bytes.hpp"

#include <cstring>
#include <limits>
#include <type_traits>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

constexpr std::string_view kMark = "bathyal navigation state 1\n";

struct Writer {
  std::string bytes{kMark};

  void raw(void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); }
  std::size_t count(std::size_t size) {
    raw(&size, sizeof size);
    return size;
  }
};

struct Reader {
  std::string_view left;

  void raw(void* data, std::size_t size) {
    if (left.size() < size) refuse("fewer");
    std::memcpy(data, left.data(), size);
    left.remove_prefix(size);
  }
  std::size_t count(std::size_t /*size*/) {
    std::size_t size = 0;
    raw(&size, sizeof size);
    if (size > left.size()) refuse("fewer");
    return size;
  }
  [[noreturn]] static void refuse(const char* got) {
    throw_argument("state", "the bytes of a navigation filter's state", got);
  }
};

template <class Stream, class Number>
void put(Stream& stream,
         Number& number) requires std::is_arithmetic_v<Number> || std::is_enum_v<Number> {
  if constexpr (std::is_same_v<Number, bool>) {
    unsigned char byte = number ? 1 : 0;
    stream.raw(&byte, 1);
    number = byte != 0;
  } else {
    stream.raw(&number, sizeof number);
  }
}

template <class Stream, int Rows, int Cols>
void put(Stream& stream, Eigen::Matrix<double, Rows, Cols>& numbers) {
  stream.raw(numbers.data(), sizeof(double) * Rows * Cols);
}

template <class Stream>
void put(Stream& stream, SensorReading& r) {
  put(stream, r.kind);
  put(stream, r.time);
  put(stream, r.arrival);
  put(stream, r.index);
  for (double& value : r.values) put(stream, value);
  put(stream, r.count);
  put(stream, r.valid);
}

template <class Stream>
void put(Stream& stream, NavigationEstimate& e) {
  put(stream, e.time);
  put(stream, e.position);
  put(stream, e.velocity);
  put(stream, e.attitude);
  put(stream, e.gyro_bias);
  put(stream, e.accel_bias);
  put(stream, e.log_scale);
  put(stream, e.log_mount);
  put(stream, e.current);
  put(stream, e.fix_lever);
  put(stream, e.covariance);
  put(stream, e.input);
  put(stream, e.input_time);
  put(stream, e.rate);
  put(stream, e.force);
  put(stream, e.reported);
  put(stream, e.steps);
}

template <class Stream>
void put(Stream& stream, NavigationInput& i) {
  put(stream, i.kind);
  put(stream, i.time);
  put(stream, i.first);
  put(stream, i.second);
  put(stream, i.attitude);
  put(stream, i.reading);
  put(stream, i.device);
}

template <class Stream>
void put(Stream& stream, NavigationSnapshot& s) {
  put(stream, s.estimate);
  put(stream, s.next_input);
}

template <class Stream, class Item>
void put(Stream& stream, std::vector<Item>& items) {
  const std::size_t count = stream.count(items.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (i == items.size()) items.emplace_back();
    put(stream, items[i]);
  }
}

template <class Stream>
void put(Stream& stream, NavigationState& state) {
  put(stream, state.now);
  put(stream, state.dropped);
  put(stream, state.inputs);
  put(stream, state.snapshots);
}

}  // namespace

std::string to_bytes(const NavigationState& state) {
  Writer writer;
  NavigationState copy = state;
  put(writer, copy);
  return std::move(writer.bytes);
}

NavigationState navigation_state_of(std::string_view bytes) {
  if (bytes.substr(0, kMark.size()) != kMark) Reader::refuse("others");
  Reader reader{bytes.substr(kMark.size())};
  NavigationState state;
  put(reader, state);
  if (!reader.left.empty()) Reader::refuse("more");
  return state;
}

}  // namespace bathyal
