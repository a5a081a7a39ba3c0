// The functions that read pictures: they ask the reading process (read-server.cpp) over a socket, so that a decoder
// that crashes does not harm this process.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "celdepth-io.hpp"
#include "read-wire.hpp"

#include <cerrno>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include <dlfcn.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

struct DescribedPart
{
  CeldIoPart  info;
  std::string name, profile;
};

struct CeldIoFile
{
  std::string                path; // as it was given
  std::unique_ptr<Wire>      wire;
  std::vector<DescribedPart> parts;
  int                        width, height;
};

// ------------------------------------------------------------------ the reading process

constexpr const char *helper_name = "celdepth-read";

// Owns both ends, which are close-on-exec.
struct SocketPair
{
  int ours = -1, theirs = -1;

  SocketPair ()
  {
    int ends[2];

    if (socketpair (AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends))
      throw IoFailure ("too many files are open.");
    ours = ends[0], theirs = ends[1];
  }
  ~SocketPair ()
  {
    for (int end : { ours, theirs })
      if (end >= 0)
        close (end);
  }
  SocketPair (const SocketPair &) = delete;
  SocketPair &operator= (const SocketPair &) = delete;
};

// Takes over a descriptor from its owner.
static int
take (int &descriptor)
{
  const int taken = descriptor;

  descriptor = -1;
  return taken;
}

// The path of celdepth-read: beside this module or program, where a build or a user puts it, or else where it is
// installed.
static std::string
find_helper ()
{
  Dl_info here;

  if (dladdr (reinterpret_cast<const void *> (&celd_io_open), &here) && here.dli_fname)
    {
      const std::filesystem::path beside = std::filesystem::path (here.dli_fname).replace_filename (helper_name);

      if (access (beside.c_str (), X_OK) == 0)
        return beside;
    }
  return std::string (CELD_LIBEXEC_FOLDER) + "/" + helper_name;
}

// Waits until the started process has forked the server and exited.
static void
wait_for_starter (pid_t process)
{
  while (waitpid (process, nullptr, 0) < 0 && errno == EINTR)
    continue;
}

// Starts celdepth-read by posix_spawn, since a host with threads must not fork.
static void
start_helper (const SocketPair &pair)
{
  const std::string          helper = find_helper ();
  char                      *words[] = { const_cast<char *> (helper.c_str ()), nullptr };
  posix_spawn_file_actions_t files;
  posix_spawnattr_t          attributes;
  sigset_t                   none, all;
  pid_t                      process;
  int                        status;

  sigemptyset (&none);
  sigfillset (&all);
  posix_spawnattr_init (&attributes);
  posix_spawnattr_setsigmask (&attributes, &none);
  posix_spawnattr_setsigdefault (&attributes, &all);
  posix_spawnattr_setflags (&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawn_file_actions_init (&files);
  posix_spawn_file_actions_adddup2 (&files, pair.theirs, control_descriptor);
  status = posix_spawn (&process, helper.c_str (), &files, &attributes, words, environ);
  posix_spawn_file_actions_destroy (&files);
  posix_spawnattr_destroy (&attributes);
  if (status)
    throw IoFailure ("the program " + helper + ", which reads files, cannot be started. Install celdepth again.");
  wait_for_starter (process);
}

// The control socket of the server; -1 before the first file.
struct Server
{
  std::mutex mutex;
  int        control = -1;

  ~Server ()
  {
    if (control >= 0)
      close (control);
  }
};

static Server server;

// Connects to a new worker; null if the server does not run any more, or cannot fork one.
static std::unique_ptr<Wire>
ask_for_worker (int control)
{
  SocketPair            pair;
  std::unique_ptr<Wire> wire;

  if (!send_descriptor (control, pair.theirs))
    return nullptr;
  close (take (pair.theirs));
  wire = std::make_unique<Wire> (take (pair.ours));
  try
    {
      if (wire->receive<uint32_t> () == wire_version)
        return wire;
    }
  catch (const WireFailure &)
    {
      return nullptr;
    }
  throw IoFailure ("the program " + std::string (helper_name) + " belongs to another version of celdepth. Install both "
                   "from the same version.");
}

// Connects to a new worker, and starts the server first if it does not run, or has exited after some time without work.
static std::unique_ptr<Wire>
start_worker ()
{
  const std::lock_guard<std::mutex> lock (server.mutex);
  std::unique_ptr<Wire>             wire;

  if (server.control >= 0)
    wire = ask_for_worker (server.control);
  if (!wire)
    {
      SocketPair pair;

      if (server.control >= 0)
        close (take (server.control));
      start_helper (pair);
      server.control = take (pair.ours);
      close (take (pair.theirs));
      wire = ask_for_worker (server.control);
    }
  if (!wire)
    throw IoFailure ("the program " + std::string (helper_name) + ", which reads files, does not respond.");
  return wire;
}

void
celd_io_fork_reader (void)
{
  const std::lock_guard<std::mutex> lock (server.mutex);
  int                               ends[2];
  pid_t                             process;

  if (server.control >= 0 || socketpair (AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends))
    return;
  process = fork ();
  if (process == 0)
    {
      close (ends[0]);
      if (fork () == 0)
        serve_readers (ends[1], -1);
      _exit (0);
    }
  close (ends[1]);
  if (process > 0)
    wait_for_starter (process);
  server.control = ends[0];
}

// ------------------------------------------------------------------ requests

// Throws the worker's reason if it reports a failure.
static void
check_answer (const Wire &wire)
{
  if (wire.receive<Answer> () != Answer::good)
    throw IoFailure (wire.receive_text ());
}

// Does the work; reports a worker that died as a damaged file.
template <typename Work>
static bool
guarded_read (const std::string &path, CeldIoError *error, Work work)
{
  return guarded ("read", path, error, [&] {
    try
      {
        work ();
      }
    catch (const WireFailure &)
      {
        throw IoFailure ("it is damaged (decoding it crashed, or needed too much time or memory).");
      }
  });
}

static void
receive_part (const Wire &wire, DescribedPart &part)
{
  part.name = wire.receive_text ();
  part.info.alpha = wire.receive<uint8_t> ();
  part.info.grey = wire.receive<uint8_t> ();
  part.info.linear = wire.receive<uint8_t> ();
  part.info.frame = wire.receive<uint8_t> ();
  part.info.bits = wire.receive<int> ();
  part.profile = wire.receive_text (longest_profile);
}

static void
open_file (CeldIoFile &file)
{
  file.wire = start_worker ();
  if (file.path.empty ())
    throw IoFailure ("its name is empty.");
  file.wire->send (Request::open);
  file.wire->send_text (std::filesystem::absolute (file.path).string ());
  check_answer (*file.wire);
  file.width = file.wire->receive<int> ();
  file.height = file.wire->receive<int> ();
  if (file.width < 1 || file.height < 1 || file.width > CELD_MAX_SIDE || file.height > CELD_MAX_SIDE)
    throw WireFailure ("invalid size");
  for (uint64_t n = file.wire->receive<uint64_t> (); n > 0; n--)
    {
      file.parts.emplace_back ();
      receive_part (*file.wire, file.parts.back ());
    }
  if (file.parts.empty ())
    throw WireFailure ("no parts");
  for (DescribedPart &part : file.parts)
    part.info.name = part.name.c_str ();
}

// Reads a part into a picture of the canvas with `floats` numbers per pixel.
static void
read_pixels (const CeldIoFile &file, size_t part, Request request, size_t floats, float *pixels)
{
  const Wire  &wire = *file.wire;
  const size_t width = size_t (file.width), height = size_t (file.height);
  CeldRect     visible;
  int          y;

  wire.send (request);
  wire.send (uint64_t (part));
  check_answer (wire);
  visible = wire.receive<CeldRect> ();
  if (visible.x < 0 || visible.y < 0 || visible.width < 0 || visible.height < 0 ||
      visible.width > file.width - visible.x || visible.height > file.height - visible.y)
    throw WireFailure ("invalid rectangle");
  // A part that covers the canvas is not cleared first, so that a damaged file does not use the memory of all the
  // pixels that it claims to have.
  if (visible.width < file.width || visible.height < file.height)
    std::fill (pixels, pixels + floats * width * height, 0.f);
  y = visible.y;
  for (int32_t rows; (rows = wire.receive<int32_t> ()) != 0;)
    {
      if (rows == -1)
        throw IoFailure (wire.receive_text ());
      if (rows < 0 || rows > visible.y + visible.height - y)
        throw WireFailure ("invalid number of rows");
      if (visible.width == file.width)
        wire.receive (pixels + floats * width * size_t (y), sizeof (float) * floats * width * size_t (rows));
      else
        for (int j = y; j < y + rows; j++)
          wire.receive (pixels + floats * (width * size_t (j) + size_t (visible.x)),
                        sizeof (float) * floats * size_t (visible.width));
      y += rows;
    }
  if (y < visible.y + visible.height && visible.width)
    throw WireFailure ("rows are missing");
}

// ------------------------------------------------------------------ the C functions

CeldIoFile *
celd_io_open (const char *path, CeldIoError *error)
{
  CeldIoFile *file = nullptr;

  if (guarded_read (path, error, [&] {
        file = new CeldIoFile ();
        file->path = path;
        open_file (*file);
      }))
    return file;
  delete file;
  return nullptr;
}

void
celd_io_close (CeldIoFile *file)
{
  delete file;
}

int
celd_io_width (const CeldIoFile *file)
{
  return file->width;
}

int
celd_io_height (const CeldIoFile *file)
{
  return file->height;
}

size_t
celd_io_parts (const CeldIoFile *file)
{
  return file->parts.size ();
}

const CeldIoPart *
celd_io_part (const CeldIoFile *file, size_t part)
{
  return &file->parts[part].info;
}

// Compares names, ignoring the case of ASCII letters in any locale.
static bool
same_name (const std::string &a, const char *b)
{
  const auto lower = [] (char c) { return c >= 'A' && c <= 'Z' ? char (c - 'A' + 'a') : c; };
  size_t     i = 0;

  while (i < a.size () && b[i] && lower (a[i]) == lower (b[i]))
    i++;
  return i == a.size () && !b[i];
}

size_t
celd_io_find (const CeldIoFile *file, const char *name)
{
  for (size_t i = 0; i < file->parts.size (); i++)
    if (same_name (file->parts[i].name, name))
      return i;
  return CELD_NO_INDEX;
}

const char *
celd_io_profile (const CeldIoFile *file, size_t part, size_t *size)
{
  const std::string &profile = file->parts[part].profile;

  *size = profile.size ();
  return profile.empty () ? nullptr : profile.data ();
}

bool
celd_io_read_colours (CeldIoFile *file, size_t part, float *rgba, CeldIoError *error)
{
  return guarded_read (file->path, error, [&] { read_pixels (*file, part, Request::colours, 4, rgba); });
}

bool
celd_io_read_values (CeldIoFile *file, size_t part, float *values, CeldIoError *error)
{
  return guarded_read (file->path, error, [&] { read_pixels (*file, part, Request::values, 1, values); });
}
