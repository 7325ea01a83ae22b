/* Gives every C++ object pages of its own and takes them away with it, so that a use after that is
 * a crash. Loaded before the C++ library. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <sys/mman.h>

#define PAGE 4096u

void *_Znwm(size_t size)
{
    const size_t whole = (size + 2 * PAGE - 1) / PAGE * PAGE;
    size_t *pages = mmap(NULL, whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED)
        abort();
    pages[0] = whole;
    return (char *)pages + PAGE;
}

void _ZdlPv(void *object)
{
    size_t *pages = (size_t *)((char *)object - PAGE);
    if (object != NULL)
        mprotect(pages, pages[0], PROT_NONE);
}

void _ZdlPvm(void *object, size_t size)
{
    (void)size;
    _ZdlPv(object);
}
