/* Vectors of the widest kind that the machine has; arithmetic is written with operators. */
#include <immintrin.h>
#include <stdint.h>

#if defined(__AVX512F__) && defined(__AVX512DQ__)

enum { WIDTH = 8 };
typedef __m512d Numbers;
typedef __m512i Words;
typedef __mmask8 Truths;

#define LOAD(from) _mm512_loadu_pd(from)
#define LOAD_WORDS(from) _mm512_loadu_si512(from)
#define STORE(to, x) _mm512_storeu_pd(to, x)
#define ALL(x) _mm512_set1_pd(x)
#define WHOLE(x) _mm512_set1_epi64(x)
#define BELOW(a, b) _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ)
#define AT_MOST(a, b) _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ)
#define EQUAL(a, b) _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ)
#define SAME(a, b) _mm512_cmpeq_epi64_mask(a, b)
#define ODD(words) _mm512_test_epi64_mask(words, WHOLE(1))
#define PICK(truths, then, otherwise) _mm512_mask_blend_pd(truths, otherwise, then)
#define WORD(truths, then, otherwise) _mm512_mask_blend_epi64(truths, otherwise, then)
#define ADDED(sum, truths, x) _mm512_mask_add_pd(sum, truths, sum, x)
#define RAISED(best, truths, bid) _mm512_mask_max_epi64(best, truths, best, bid)
#define ROOT(x) _mm512_sqrt_pd(x)
#define SIZE(x) _mm512_abs_pd(x)
#define LESSER(a, b) _mm512_min_pd(a, b)
#define GREATER(a, b) _mm512_max_pd(a, b)
#define TRUNCATED(x) _mm512_cvttpd_epi64(x)
#define SHIFTED(words, by) _mm512_srlv_epi64(words, by)
#define PLUS(a, b) _mm512_add_epi64(a, b)
#define BOTH_BITS(a, b) _mm512_and_si512(a, b)

#elif defined(__AVX2__)

enum { WIDTH = 4 };
typedef __m256d Numbers;
typedef __m256i Words;
typedef __m256d Truths;

#define LOAD(from) _mm256_loadu_pd(from)
#define LOAD_WORDS(from) _mm256_loadu_si256((const Words *)(from))
#define STORE(to, x) _mm256_storeu_pd(to, x)
#define ALL(x) _mm256_set1_pd(x)
#define WHOLE(x) _mm256_set1_epi64x(x)
#define BELOW(a, b) _mm256_cmp_pd(a, b, _CMP_LT_OQ)
#define AT_MOST(a, b) _mm256_cmp_pd(a, b, _CMP_LE_OQ)
#define EQUAL(a, b) _mm256_cmp_pd(a, b, _CMP_EQ_OQ)
#define SAME(a, b) _mm256_castsi256_pd(_mm256_cmpeq_epi64(a, b))
#define ODD(words) SAME(BOTH_BITS(words, WHOLE(1)), WHOLE(1))
#define PICK(truths, then, otherwise) _mm256_blendv_pd(otherwise, then, truths)
#define WORD(truths, then, otherwise) \
    _mm256_castpd_si256(PICK(truths, _mm256_castsi256_pd(then), _mm256_castsi256_pd(otherwise)))
#define ADDED(sum, truths, x) PICK(truths, sum + (x), sum)
#define RAISED(best, truths, bid) \
    WORD(_mm256_and_pd(truths, _mm256_castsi256_pd(_mm256_cmpgt_epi64(bid, best))), bid, best)
#define ROOT(x) _mm256_sqrt_pd(x)
#define SIZE(x) _mm256_andnot_pd(ALL(-0.0), x)
#define LESSER(a, b) _mm256_min_pd(a, b)
#define GREATER(a, b) _mm256_max_pd(a, b)
#define TRUNCATED(x) _mm256_cvtepi32_epi64(_mm256_cvttpd_epi32(x))
#define SHIFTED(words, by) _mm256_srlv_epi64(words, by)
#define PLUS(a, b) _mm256_add_epi64(a, b)
#define BOTH_BITS(a, b) _mm256_and_si256(a, b)

#else
#error "needs AVX2 or AVX-512"
#endif
