// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_MEMBER_H
#define GNOMON_MOMENTS_WORD_MEMBER_H
GNOMON_STRUCT pair { Real first, half; };
#endif
