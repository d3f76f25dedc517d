// The functions that the recorder has in front of a GL, each with a number: commands that are recorded, other
// forms of these, commands that are counted, and functions of window systems.
#pragma once

// The build defines GL_GLEXT_PROTOTYPES. Only the types of the declarations are used.
#include <GL/gl.h>
#include <GL/glext.h>

#include <string_view>

// clang-format off
#define EVALCTS_WITH_V(X, name, recorded, n) X(name, recorded, n) X(name##v, recorded, 1)
#define EVALCTS_SHORT_AND_INT(X, name, n) EVALCTS_WITH_V(X, name##s, name##d, n) EVALCTS_WITH_V(X, name##i, name##d, n)
#define EVALCTS_ALL_INTEGERS(X, name, n) EVALCTS_SHORT_AND_INT(X, name, n) \
  EVALCTS_WITH_V(X, name##b, name##d, n) EVALCTS_WITH_V(X, name##ub, name##d, n) \
  EVALCTS_WITH_V(X, name##us, name##d, n) EVALCTS_WITH_V(X, name##ui, name##d, n)
#define EVALCTS_UNIT(X, n, parameters) \
  X(MultiTexCoord##n##s, MultiTexCoord##n##d, parameters) X(MultiTexCoord##n##sv, MultiTexCoord##n##d, 2) \
  X(MultiTexCoord##n##i, MultiTexCoord##n##d, parameters) X(MultiTexCoord##n##iv, MultiTexCoord##n##d, 2) \
  X(MultiTexCoord##n##sARB, MultiTexCoord##n##d, parameters) X(MultiTexCoord##n##svARB, MultiTexCoord##n##d, 2) \
  X(MultiTexCoord##n##iARB, MultiTexCoord##n##d, parameters) X(MultiTexCoord##n##ivARB, MultiTexCoord##n##d, 2)
#define EVALCTS_UNIT_ALIAS(X, n, parameters) \
  X(MultiTexCoord##n##fARB, MultiTexCoord##n##f, parameters) X(MultiTexCoord##n##fvARB, MultiTexCoord##n##fv, 2) \
  X(MultiTexCoord##n##dARB, MultiTexCoord##n##d, parameters) X(MultiTexCoord##n##dvARB, MultiTexCoord##n##dv, 2)

// X(command, command with doubles that it is recorded as, number of parameters)
#define EVALCTS_CONVERTED(X) \
  EVALCTS_SHORT_AND_INT(X, Vertex2, 2) EVALCTS_SHORT_AND_INT(X, Vertex3, 3) EVALCTS_SHORT_AND_INT(X, Vertex4, 4) \
  EVALCTS_ALL_INTEGERS(X, Color3, 3) EVALCTS_ALL_INTEGERS(X, Color4, 4) \
  EVALCTS_SHORT_AND_INT(X, Normal3, 3) EVALCTS_WITH_V(X, Normal3b, Normal3d, 3) \
  EVALCTS_SHORT_AND_INT(X, TexCoord1, 1) EVALCTS_SHORT_AND_INT(X, TexCoord2, 2) \
  EVALCTS_SHORT_AND_INT(X, TexCoord3, 3) EVALCTS_SHORT_AND_INT(X, TexCoord4, 4) \
  EVALCTS_SHORT_AND_INT(X, Index, 1) EVALCTS_WITH_V(X, Indexub, Indexd, 1) \
  EVALCTS_UNIT(X, 1, 2) EVALCTS_UNIT(X, 2, 3) EVALCTS_UNIT(X, 3, 4) EVALCTS_UNIT(X, 4, 5)

// X(name of an extension, name of the core, number of parameters)
#define EVALCTS_ALIASES(X) X(ActiveTextureARB, ActiveTexture, 1) \
  EVALCTS_UNIT_ALIAS(X, 1, 2) EVALCTS_UNIT_ALIAS(X, 2, 3) EVALCTS_UNIT_ALIAS(X, 3, 4) EVALCTS_UNIT_ALIAS(X, 4, 5)

#define EVALCTS_WINDOW_SYSTEMS(X) \
  X(glXMakeCurrent) X(glXMakeContextCurrent) X(glXMakeCurrentReadSGI) X(glXDestroyContext) X(glXSwapBuffers) \
  X(glXSwapBuffersMscOML) X(glXGetProcAddress) X(glXGetProcAddressARB) \
  X(eglMakeCurrent) X(eglReleaseThread) X(eglDestroyContext) X(eglSwapBuffers) X(eglSwapBuffersWithDamageKHR) \
  X(eglSwapBuffersWithDamageEXT) X(eglGetProcAddress) \
  X(OSMesaMakeCurrent) X(OSMesaDestroyContext) X(OSMesaGetProcAddress)
// clang-format on

namespace evalcts::record {

// Numbers of the functions. Those of recorded commands are also their numbers in the file.
enum Number : int {
#define RECORDED(name, parameters) k##name,
#include <recorded.def>
#undef RECORDED
  kRecordedEnd,
  kBeforeConverted = kRecordedEnd - 1,
#define X(name, recorded, parameters) k##name,
  EVALCTS_CONVERTED(X) kConvertedEnd,
  kBeforeAliases = kConvertedEnd - 1,
  EVALCTS_ALIASES(X) kAliasesEnd,
#undef X
  kBeforeCounted = kAliasesEnd - 1,
#define COUNTED(name, parameters) k##name,
#include <counted.def>
#undef COUNTED
  kCountedEnd,
  kBeforeWindowSystems = kCountedEnd - 1,
#define X(name) k##name,
  EVALCTS_WINDOW_SYSTEMS(X) kFunctions
#undef X
};

// Numbers of the events in the file.
enum Event : int { kContextEvent = kRecordedEnd, kDestroyEvent, kFrameEvent };

inline constexpr int kCounted = kCountedEnd - kAliasesEnd;

// The names of the functions.
inline constexpr const char* kNames[] = {
#define RECORDED(name, parameters) "gl" #name,
#include <recorded.def>
#undef RECORDED
#define X(name, recorded, parameters) "gl" #name,
    EVALCTS_CONVERTED(X) EVALCTS_ALIASES(X)
#undef X
#define COUNTED(name, parameters) "gl" #name,
#include <counted.def>
#undef COUNTED
#define X(name) #name,
        EVALCTS_WINDOW_SYSTEMS(X)
#undef X
};

// The numbers of the commands that other forms are recorded as.
inline constexpr int kRecordedAs[] = {
#define X(name, recorded, parameters) k##recorded,
    EVALCTS_CONVERTED(X) EVALCTS_ALIASES(X)
#undef X
};

constexpr int recorded_as(int number) {
  return number < kRecordedEnd ? number : kRecordedAs[number - kRecordedEnd];
}

// Returns the name of a command without "gl".
constexpr std::string_view short_name(int number) { return kNames[number] + 2; }

}  // namespace evalcts::record
