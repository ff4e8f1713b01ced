// expect: pragma
#ifndef GNOMON_MOMENTS_PRAGMA_ONCE_H
#define GNOMON_MOMENTS_PRAGMA_ONCE_H
#pragma once
#endif
