// Macros of headers that a user may have included before, between or after those of gnomon, as they define them there. The
// linter reads this list: no header of gnomon may use one of these names so that the macro would replace it.
#pragma once

// windows.h and what it includes: minwindef.h, wingdi.h, winnt.h, winerror.h, combaseapi.h, rpcndr.h, dlgs.h, tchar.h.
#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define near
#define far
#define NEAR near
#define FAR far
#define small char
#define hyper long long
#define interface struct
#define pascal
#define cdecl
#define _cdecl
#define CALLBACK
#define WINAPI
#define IN
#define OUT
#define OPTIONAL
#define CONST const
#define VOID void
#define THIS void
#define PURE = 0
#define TRUE 1
#define FALSE 0
#define ERROR 0
#define NO_ERROR 0L
#define DELETE (0x00010000L)
#define ABSOLUTE 1
#define RELATIVE 2
#define DIFFERENCE 11
#define TRANSPARENT 1
#define OPAQUE 2
#define ALTERNATE 1
#define WINDING 2
#define STRICT 1
#define TEXT(quote) L##quote
#define _T(x) L##x
#define grp1 0x0430
#define frm1 0x0434
#define rct1 0x0438
#define lst1 0x0460
#define lst2 0x0461
#define rad1 0x0420
#define ctl1 0x04A0

// math.h of MSVC, and of glibc before 2.27.
#define DOMAIN 1
#define SING 2
#define OVERFLOW 3
#define UNDERFLOW 4
#define PLOSS 6

// X11/X.h, X11/Xlib.h.
#define None 0L
#define Bool int
#define Status int
#define True 1
#define False 0
#define Success 0
#define Always 2
#define Above 0
#define Below 1
#define Opposite 4
#define Unsorted 0
#define Complex 0
#define Convex 2
#define Nonconvex 1
#define CursorShape 0
#define KeyPress 2
#define FocusIn 9
#define Expose 12
#define BadValue 2
#define DestroyAll 0

// glibc: complex.h, sys/sysmacros.h, sys/param.h, math.h; ctype.h of newlib and the BSDs; GCC without -std.
#define I _Complex_I
#define complex _Complex
#define major(dev) gnu_dev_major(dev)
#define minor(dev) gnu_dev_minor(dev)
#define makedev(major, minor) gnu_dev_makedev(major, minor)
#define howmany(x, y) (((x) + ((y)-1)) / (y))
#define roundup(x, y) ((((x) + ((y)-1)) / (y)) * (y))
#define MIN(a, b) (((a) < (b)) ? (a) : (b))
#define MAX(a, b) (((a) > (b)) ? (a) : (b))
#undef M_PI
#define M_PI 3.14159265358979323846
#define _U 01
#define _L 02
#define _N 04
#define _S 010
#define _P 020
#define _C 040
#define _X 0100
#define _B 0200
#undef unix
#define unix 1
#undef linux
#define linux 1

// altivec.h.
#define pixel __pixel

// AssertMacros.h and objc.h of Apple; Unreal Engine's AssertionMacros.h and UnrealMathUtility.h; glog.
#define check(expression) ((void)(expression))
#define verify(expression) ((void)(expression))
#define require(expression, label) ((void)(expression))
#define ensure(expression) (!!(expression))
#define checkf(expression, ...) ((void)(expression))
#define unimplemented() ((void)0)
#define nil nullptr
#define YES 1
#define NO 0
#define PI (3.1415926535897932f)
#define TWO_PI (6.283185307179586476925286766559)
#define HALF_PI (1.57079632679f)
#define INV_PI (0.31830988618f)
#define SMALL_NUMBER (1.e-8f)
#define DELTA (0.00001f)
#define INDEX_NONE (-1)
#define CHECK(condition) ((void)(condition))
#define LOG(severity) severity
#define INFO 0
#define WARNING 1
#define FATAL 3

// Qt's qobjectdefs.h and qglobal.h.
#define emit
#define signals public
#define slots
#define foreach(variable, container) for (variable : container)
#define forever for (;;)

// Arduino.h, binary.h.
#define constrain(amt, low, high) ((amt) < (low) ? (low) : ((amt) > (high) ? (high) : (amt)))
#define radians(deg) ((deg)*DEG_TO_RAD)
#define degrees(rad) ((rad)*RAD_TO_DEG)
#define sq(x) ((x) * (x))
#define bit(b) (1UL << (b))
#define word(...) makeWord(__VA_ARGS__)
#define HIGH 0x1
#define LOW 0x0
#define INPUT 0x0
#define OUTPUT 0x1
#define EULER 2.718281828459045235360287471352
#define DEFAULT 1
#define EXTERNAL 0
#define INTERNAL 3
#define CHANGE 1
#define B0 0
#define B1 1
#define B01 1
#define B10 2
#define F(string_literal) (string_literal)

// What games and shader ports define for themselves.
#define saturate(x) clamp(x, 0, 1)
#define real double
#define assume(x) __assume(x)
#define EPSILON 1e-6
#define ALIGN(x) __attribute__((aligned(x)))
#define BIT(n) (1u << (n))
#define ABS(x) ((x) < 0 ? -(x) : (x))
#define SIGN(x) ((x) < 0 ? -1 : 1)
#define CLAMP(x, low, high) ((x) < (low) ? (low) : (x) > (high) ? (high) : (x))
#define likely(x) __builtin_expect(!!(x), 1)
#define unlikely(x) __builtin_expect(!!(x), 0)
#define countof(array) (sizeof(array) / sizeof(array[0]))
#define offset_of(type, member) ((size_t) & (((type*)0)->member))

// Those that the headers of the standard library do not survive themselves, and that hence come after them.
#ifndef GNOMON_TEST_MACROS_FIRST

// math.h of C; Arduino.h.
#define isnan(x) ((x) != (x))
#define isinf(x) ((x) - (x) != 0)
#define isfinite(x) ((x) - (x) == 0)
#define isunordered(x, y) ((x) != (x) || (y) != (y))
#define signbit(x) ((x) < 0)
#define abs(x) ((x) > 0 ? (x) : -(x))
#define round(x) ((x) >= 0 ? (long)((x) + 0.5) : (long)((x)-0.5))

// Sockets of lwIP and of Ruby on Windows.
#define select(nfds, readfds, writefds, exceptfds, timeout) lwip_select(nfds, readfds, writefds, exceptfds, timeout)
#define accept(s, addr, addrlen) lwip_accept(s, addr, addrlen)
#define bind(s, name, namelen) lwip_bind(s, name, namelen)
#define read(s, mem, len) lwip_read(s, mem, len)
#define write(s, dataptr, len) lwip_write(s, dataptr, len)

// What games and shader ports define for themselves.
#define clamp(x, low, high) ((x) < (low) ? (low) : (x) > (high) ? (high) : (x))
#define lerp(a, b, t) ((a) + (t) * ((b) - (a)))
#define index(s, c) strchr(s, c)
#define swap(a, b) ((a) ^= (b) ^= (a) ^= (b))
#define any(x) (x)
#define all(x) (x)

#endif
