// Messages between a program that wants pictures and the process that reads them, over a stream socket.
//
// Numbers and pixels travel as they lie in memory: both ends are of one build, on one machine.  Neither end trusts a
// length: sizes are checked before memory is taken.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_READ_WIRE_HPP
#define CELDEPTH_READ_WIRE_HPP

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>

// The other end is gone, or sends what no message has.
struct WireFailure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

// What the reading process says first.  Changes whenever a message does: a module may meet a helper of another version.
constexpr uint32_t wire_greeting = 0xCE1D0001;

// The descriptor of the helper that is its end of the control socket.
constexpr int control_descriptor = 3;

enum class Request : uint8_t { open, colours, values };
enum class Answer : uint8_t { good, failed };

// Longest text (path, name, message) and longest ICC profile.
constexpr size_t longest_text = size_t (1) << 16;
constexpr size_t longest_profile = size_t (1) << 26;

// Owns its end of the socket.
class Wire
{
public:
  explicit Wire (int descriptor) : end (descriptor) {}
  ~Wire ();
  Wire (const Wire &) = delete;
  Wire &operator= (const Wire &) = delete;

  // All bytes or a WireFailure.
  void send (const void *bytes, size_t size) const;
  void receive (void *bytes, size_t size) const;

  // A number, or a few in a struct.
  template <typename Value>
  void
  send (Value value) const
  {
    static_assert (std::is_trivial<Value>::value && !std::is_pointer<Value>::value);
    send (&value, sizeof value);
  }

  template <typename Value>
  Value
  receive () const
  {
    Value value;

    static_assert (std::is_trivial<Value>::value && !std::is_pointer<Value>::value);
    receive (&value, sizeof value);
    return value;
  }

  void        send_text (const std::string &text, size_t longest = longest_text) const; // cut at `longest`
  std::string receive_text (size_t longest = longest_text) const;

private:
  int end;
};

// Hands a descriptor over; false if nobody listens.
bool send_descriptor (int socket, int descriptor);

// The next descriptor, close-on-exec; -1 when the other end is gone, or after `patience` milliseconds (-1: none).
int receive_descriptor (int socket, int patience);

// Answers requests on the control socket until the other end closes it, each file in a process of its own.  Leaves as
// well when nobody asks for `patience` milliseconds.  The caller's process must have one thread only.
void serve_readers (int control, int patience);

#endif
