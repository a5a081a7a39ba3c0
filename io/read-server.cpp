// The process that reads files for programs that must not crash.
//
// A damaged file can crash the library that decodes it, or make it ask for any amount of memory.  So the server, which
// itself decodes nothing, makes a copy of itself (a worker) for each file.  A worker has limits on memory and time; when
// it dies, its end of the socket closes, and that is all that the program at the other end sees of it.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-file.hpp"
#include "read-wire.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <limits>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
#define CELD_SANITIZED true
#elif defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CELD_SANITIZED true
#endif
#endif
#ifndef CELD_SANITIZED
#define CELD_SANITIZED false
#endif

// ------------------------------------------------------------------ limits of a worker

constexpr uint64_t megabyte = uint64_t (1) << 20;
constexpr uint64_t opening_memory = 1024 * megabyte; // chosen: the largest WebP, which is decoded when it is opened
constexpr uint64_t working_memory = 256 * megabyte;  // chosen: strips, and the threads that decode EXR
constexpr unsigned opening_seconds = 60;             // chosen, as the next two
constexpr double   reading_seconds = 60;
constexpr double   pixels_a_second = 1e6;            // the slowest kind that was measured, on one core, makes 10e6
constexpr int      decoding_threads = 4;             // more cost memory and gain little

// Bytes of memory that the process may write to, as RLIMIT_DATA counts them; 0 if that is not known.
static uint64_t
memory_used ()
{
  std::ifstream pages ("/proc/self/statm");
  uint64_t      size, resident, shared, text, library, data;

  if (!(pages >> size >> resident >> shared >> text >> library >> data))
    return 0;
  return data * uint64_t (sysconf (_SC_PAGESIZE));
}

// Limits memory to what is used now and so much more; not with a sanitizer, whose own memory cannot be bounded.
static void
limit_memory (uint64_t more)
{
  const uint64_t used = memory_used ();
  rlimit         limit;

  if (CELD_SANITIZED || !used || getrlimit (RLIMIT_DATA, &limit))
    return;
  limit.rlim_cur = std::min<rlim_t> (used + more, limit.rlim_max);
  setrlimit (RLIMIT_DATA, &limit);
}

// ------------------------------------------------------------------ answers

static void
send_failure (const Wire &wire, const std::string &why)
{
  wire.send (Answer::failed);
  wire.send_text (why);
}

static void
send_part (const Wire &wire, const PictureFile &file, size_t part)
{
  const CeldIoPart &face = file.parts[part].face;

  wire.send_text (file.parts[part].name);
  wire.send (face.alpha);
  wire.send (face.grey);
  wire.send (face.linear);
  wire.send (face.bits);
  wire.send_text (profile_of (file, part), longest_profile);
}

static bool
answer_open (const Wire &wire, PictureFile &file)
{
  const std::string path = wire.receive_text ();
  std::string       why;

  alarm (opening_seconds);
  if (!succeeds (why, [&] { open_picture (path, file); }))
    {
      send_failure (wire, why);
      return false;
    }
  alarm (0);
  wire.send (Answer::good);
  wire.send (file.width);
  wire.send (file.height);
  wire.send (uint64_t (file.parts.size ()));
  for (size_t i = 0; i < file.parts.size (); i++)
    send_part (wire, file, i);
  return true;
}

// The rectangle, then strips: the number of rows and their pixels; 0 after the last one, -1 and a text after a failure.
static void
answer_pixels (const Wire &wire, PictureFile &file, Request request)
{
  const size_t part = size_t (wire.receive<uint64_t> ());
  const size_t floats = request == Request::colours ? 4 : 1;
  CeldRect     seen;
  std::string  why;

  if (!succeeds (why, [&] { seen = part_on_canvas (file, part); }))
    {
      send_failure (wire, why);
      return;
    }
  limit_memory (working_memory + decoding_memory (file, part) + 16 * file.size);
  alarm (unsigned (reading_seconds + double (file.width) * double (file.height) / pixels_a_second));
  wire.send (Answer::good);
  wire.send (seen);
  const bool read = succeeds (why, [&] {
    const TakeRows take = [&] (const float *rows, int count) {
      wire.send (int32_t (count));
      wire.send (rows, sizeof (float) * floats * size_t (seen.width) * size_t (count));
    };

    request == Request::colours ? read_colours (file, part, take) : read_values (file, part, take);
  });
  alarm (0);
  wire.send (int32_t (read ? 0 : -1));
  if (!read)
    wire.send_text (why);
}

// ------------------------------------------------------------------ processes

// Serves one file until the other end closes the socket.
static void
work (const Wire &wire)
{
  PictureFile file;

  prctl (PR_SET_DUMPABLE, 0); // a crash is expected and leaves no core file
  OIIO::attribute ("threads", decoding_threads);
  OIIO::attribute ("exr_threads", decoding_threads);
  wire.send (wire_greeting);
  if (wire.receive<Request> () != Request::open)
    return;
  limit_memory (opening_memory);
  if (!answer_open (wire, file))
    return;
  for (;;)
    answer_pixels (wire, file, wire.receive<Request> ());
}

static void
start_worker (int control, int socket)
{
  const pid_t process = fork ();

  if (process == 0)
    {
      close (control);
      std::signal (SIGCHLD, SIG_DFL);
      try
        {
          work (Wire (socket));
        }
      catch (...) // the other end is gone
        {
        }
      _exit (0);
    }
  close (socket);
}

// A session of its own, away from the signals of a terminal; silent; nothing of the program that started it but stdin.
static void
part_from_starter ()
{
  const int nowhere = open ("/dev/null", O_RDWR);

  setsid ();
  for (int number : { SIGHUP, SIGINT, SIGTERM, SIGALRM, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV })
    std::signal (number, SIG_DFL);
  std::signal (SIGCHLD, SIG_IGN); // workers vanish when they end
  if (nowhere >= 0)
    {
      dup2 (nowhere, STDOUT_FILENO);
      dup2 (nowhere, STDERR_FILENO);
      close (nowhere);
    }
}

void
serve_readers (int control, int patience)
{
  int socket;

  part_from_starter ();
  while ((socket = receive_descriptor (control, patience)) >= 0)
    start_worker (control, socket);
}
