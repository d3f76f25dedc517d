// The file format of recordings, "evalcts-recording-1": the evaluator commands of one process.
//
// A file is a header of FileHeader::size bytes, then chunks one behind the other. Numbers have the byte order
// of the machine that recorded. A file is valid at any time, so that a process may die at any place: the
// length of a chunk grows when a record is complete.
//
//   header   FileHeader, a JSON text of FileHeader::text_length bytes, and, at FileHeader::counts, one 64-bit
//            number for each name of "others". The text is an object:
//              "program"   the command line, an array of strings
//              "commands"  the commands of the records by their number, "Map1f:iffiip": the name without
//                          "gl" and one letter for each argument. A name with "@" is an event.
//              "others"    names of commands that are only counted
//              "frames"    the recorded frames, [first, last] from 0; missing: all
//   chunk    Chunk, then `length` bytes of records of one thread, in a space of `space` bytes
//   record   the number of the command (16 bits), then its arguments without padding:
//              i  32 bits, signed or not; booleans, enumerants and bit masks as well
//              q  64 bits
//              f  float    d  double
//              p  an array that the command reads: its size in bytes (32 bits), then its bytes; kNull or
//                 kUnknown in place of the size if there are no bytes
//              o  an array that the command writes: 32 bits, 0 or kNull
//
// Events:
//   @context:qq     the following commands of the thread are for this context (0: none); the second number
//                   orders these events of all threads
//   @destroy:q      the context was destroyed; the number may be given to another one
//   @frame:q        the buffers were swapped or, in a context of OSMesa, which does not swap, Flush or Finish
//                   was called; the number of frames before, of all contexts
#pragma once

#include <cstddef>
#include <cstdint>

namespace evalcts::record {

inline constexpr char kMagic[8] = {'E', 'V', 'A', 'L', 'R', 'E', 'C', '1'};

// Headers and chunks begin at multiples of this size, which is a multiple of the page size of all machines.
inline constexpr std::size_t kAlignment = std::size_t{1} << 16;

struct FileHeader {
  char magic[8];
  std::uint64_t size;         // of the header, a multiple of kAlignment
  std::uint64_t text_length;  // the text begins behind this structure
  std::uint64_t counts;       // offset of the counts in the file, a multiple of 8
  std::uint64_t is_cut;  // 1: the size limit was reached or the disk was full, and nothing more was recorded
};

inline constexpr std::uint32_t kChunkMagic = 0x4B4E4843;  // "CHNK"

struct Chunk {
  std::uint32_t magic;   // kChunkMagic
  std::uint32_t thread;  // number of the thread, from 0
  std::uint64_t space;   // size of the chunk with this structure, a multiple of kAlignment
  std::uint64_t length;  // size of the complete records behind this structure, in bytes
};

inline constexpr std::uint32_t kNull = 0xFFFFFFFF;  // a null pointer
// The command does not say how much it reads, or is rejected.
inline constexpr std::uint32_t kUnknown = 0xFFFFFFFE;

}  // namespace evalcts::record
