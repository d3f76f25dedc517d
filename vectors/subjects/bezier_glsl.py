#!/usr/bin/env python3
"""A GLSL shader to be judged, in single precision: evalcts vectors emit | bezier_glsl.py | evalcts vectors check.

Runs bezier.comp in OpenGL ES 3.1 without a window and skips normals. Exit code 77: no such context."""
import ctypes
import itertools
import sys
from pathlib import Path


def start():
    """Makes a context current whose program is the shader, and returns its functions."""
    egl, gl = ctypes.CDLL("libEGL.so.1"), ctypes.CDLL("libGLESv2.so.2")
    egl.eglGetPlatformDisplay.restype = egl.eglCreateContext.restype = ctypes.c_void_p
    gl.glMapBufferRange.restype = ctypes.c_void_p
    display = ctypes.c_void_p(egl.eglGetPlatformDisplay(0x31DD, None, None))  # EGL_PLATFORM_SURFACELESS_MESA
    egl.eglInitialize(display, None, None)
    egl.eglBindAPI(0x30A0)  # EGL_OPENGL_ES_API
    version = (ctypes.c_int * 5)(0x3098, 3, 0x30FB, 1, 0x3038)
    context = ctypes.c_void_p(egl.eglCreateContext(display, None, None, version))
    if not egl.eglMakeCurrent(display, None, None, context):
        raise OSError("no context of OpenGL ES 3.1")
    shader = ctypes.c_char_p(Path(__file__).with_name("bezier.comp").read_bytes())
    gl.glUseProgram(gl.glCreateShaderProgramv(0x91B9, 1, ctypes.byref(shader)))  # GL_COMPUTE_SHADER
    return gl


def buffer(gl, binding, kind, values):
    name, data = ctypes.c_uint(), (kind * len(values))(*values)
    gl.glGenBuffers(1, ctypes.byref(name))
    gl.glBindBufferBase(0x90D2, binding, name)  # GL_SHADER_STORAGE_BUFFER
    gl.glBufferData(0x90D2, ctypes.c_ssize_t(ctypes.sizeof(data)), data, 0x88E8)  # GL_DYNAMIC_DRAW
    return name


def read(words, kind, integers, floats):
    """Adds a case: its integers, and 8 floats before the control values."""
    def number():
        return float.fromhex(next(words))
    directions = int(kind[-1])
    head = [int(next(words)), int(next(words)), int(next(words)) if directions == 2 else 1, len(floats)]
    domain = [number() for _ in range(2 * directions)] + [0.0, 1.0]
    arguments = []
    for _ in range(directions):
        if kind.startswith("map"):
            segments, index, ends = 0, 0, [number(), 0.0]
        else:
            segments, ends, index = int(next(words)), [number(), number()], int(next(words))
        head += [segments, index]
        arguments += ends
    integers += (head + [0, 0])[:8]
    floats += domain[:4] + (arguments + [0.0, 0.0])[:4] + [float.fromhex(x) for x in words]


def main():
    try:
        gl = start()
    except OSError as reason:
        print(f"bezier_glsl.py: {reason}", file=sys.stderr)
        sys.exit(77)
    while lines := [line.split() for line in itertools.islice(sys.stdin, 4096)]:
        asked = [line for line in lines if "normal" not in line[0]]
        integers, floats = [], []
        for kind, _, _, *words in asked:
            read(iter(words), kind, integers, floats)
        buffers = [buffer(gl, 0, ctypes.c_int, integers), buffer(gl, 1, ctypes.c_float, floats),
                   buffer(gl, 2, ctypes.c_float, [0] * (4 * len(asked)))]
        gl.glDispatchCompute(len(asked), 1, 1)
        gl.glMemoryBarrier(0x200)  # GL_BUFFER_UPDATE_BARRIER_BIT
        pointer = gl.glMapBufferRange(0x90D2, ctypes.c_ssize_t(0), ctypes.c_ssize_t(16 * len(asked)), 1)
        results = iter((ctypes.c_float * 4 * len(asked)).from_address(pointer) if asked else [])
        for kind, name, _, k, *_ in lines:
            print(name, *(["skip"] if "normal" in kind else (x.hex() for x in next(results)[:int(k)])))
        for name in buffers:
            gl.glDeleteBuffers(1, ctypes.byref(name))


if __name__ == "__main__":
    main()
