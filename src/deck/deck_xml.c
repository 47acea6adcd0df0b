// SPDX-License-Identifier: GPL-3.0-or-later
// The only file that talks to libxml2. Hostile decks must not read files, reach the network or eat memory:
// the text comes from memory, entities and external resources are refused three times over (scanner, parser
// hook, entity loader), sizes and depths keep libxml2's limits.
#include "deck/deck.h"
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"
#include "deck/deck_position.h"

#include <libxml/parser.h>
#include <libxml/parserInternals.h>
#include <libxml/xmlschemas.h>
#include <stdlib.h>
#include <string.h>

static const char *const schema_instance = "http://www.w3.org/2001/XMLSchema-instance";
static const char *const xinclude = "http://www.w3.org/2001/XInclude";

#if LIBXML_VERSION >= 21200
typedef const xmlError *xml_error;
#else
typedef xmlError *xml_error;
#endif

/** libxml2 does not survive failed allocations (its schema parser crashes), so the process ends cleanly
 * instead. */
static void *memory_or_exit(void *memory)
{
    if (!memory) {
        error_report(STATUS_MEMORY, "out of memory while reading the deck");
        exit(STATUS_MEMORY);
    }
    return memory;
}

static void *xml_malloc(size_t size)
{
    return memory_or_exit(malloc(size ? size : 1));
}

static void *xml_realloc(void *memory, size_t size)
{
    return memory_or_exit(realloc(memory, size ? size : 1));
}

static char *xml_strdup(const char *text)
{
    return memory_or_exit(strdup(text));
}

static xmlParserInputPtr refuse_external(const char *url, const char *id, xmlParserCtxtPtr context)
{
    (void)url;
    (void)id;
    (void)context;
    return NULL;
}

static void refuse_document_type(void *context, const xmlChar *name, const xmlChar *id, const xmlChar *system)
{
    (void)name;
    (void)id;
    (void)system;
    xmlParserCtxtPtr parser = context;
    struct deck *deck = parser->_private;
    deck_error_at(deck, (struct location){xmlSAX2GetLineNumber(parser), xmlSAX2GetColumnNumber(parser)},
                  "a deck must not have a document type (<!DOCTYPE ...>) or entities");
    xmlStopParser(parser);
}

/** One line of libxml2's message. */
static void note_message(struct deck *deck, struct location where, const char *message)
{
    deck_error_at(deck, where, "%.*s", (int)strcspn(message, "\n"), message);
}

static void note_parser_error(void *context, xml_error error)
{
    xmlParserCtxtPtr parser = context;
    struct deck *deck = parser->_private;
    if (deck->n_errors == 0) // what follows the first one is its consequence
        note_message(deck, (struct location){error->line, error->int2},
                     error->message ? error->message : "not XML");
}

static void note_schema_error(void *context, xml_error error)
{
    const xmlNode *node = error->node;
    note_message(context, (struct location){node ? (int)xmlGetLineNo(node) : error->line, 1}, error->message);
}

/** Where the conversion of libxml2's tree stands. */
struct conversion {
    struct deck *deck;
    const struct positions *positions;
    size_t tag; // number of the next element in document order
};

static void convert_attribute(struct deck *deck, struct deck_node *node, xmlAttrPtr xml,
                              struct location where)
{
    const size_t n = schema_attribute_count(node->element);
    const char *name = (const char *)xml->name;
    if (xml->ns && node->id == SCHEMA_DECK && strcmp((const char *)xml->ns->href, schema_instance) == 0)
        return; // tells editors where the schema is
    for (size_t a = 0; !xml->ns && a < n; a++)
        if (strcmp(node->element->attributes[a].name, name) == 0) {
            xmlChar *value = xmlNodeListGetString(xml->doc, xml->children, 1);
            node->attributes[a].text = memory_text(value ? (const char *)value : "");
            node->attributes[a].where = where;
            xmlFree(value);
            if (!node->attributes[a].text)
                deck->status = STATUS_MEMORY;
            return;
        }
    const char *names[32];
    char suggestion[1024];
    for (size_t a = 0; a < n && a < 32; a++)
        names[a] = node->element->attributes[a].name;
    deck_suggest(name, names, n, suggestion, sizeof suggestion);
    deck_error_at(deck, where, "<%s>: unknown attribute \"%s\"%s", node->element->name, name, suggestion);
}

/** Attributes and text of one element. */
static struct deck_node *convert_element(struct conversion *conversion, xmlNodePtr xml, enum schema_id id,
                                         const struct position_tag *tag)
{
    struct deck *deck = conversion->deck;
    struct deck_node *node = deck_memory(deck, 1, sizeof *node);
    if (!node)
        return NULL;
    node->id = id;
    node->element = schema_element(id);
    node->where = tag->where;
    node->attributes = deck_memory(deck, schema_attribute_count(node->element), sizeof *node->attributes);
    size_t a = 0;
    for (xmlAttrPtr attribute = xml->properties; node->attributes && attribute;
         attribute = attribute->next, a++)
        convert_attribute(deck, node, attribute,
                          a < tag->n ? conversion->positions->attributes[tag->first + a] : tag->where);
    if (node->element->text) {
        xmlChar *content = xmlNodeGetContent(xml);
        node->text = memory_text(content ? (const char *)content : "");
        xmlFree(content);
        if (!node->text)
            deck->status = STATUS_MEMORY;
    }
    return node;
}

/** An element that has no place where it stands; @p parent: NULL at the root. */
static void refuse_element(struct deck *deck, xmlNodePtr xml, const struct schema_element *parent,
                           struct location where)
{
    const char *name = (const char *)xml->name;
    const char *names[32];
    char suggestion[1024];
    if (xml->ns && strcmp((const char *)xml->ns->href, xinclude) == 0)
        deck_error_at(deck, where, "<%s>: XInclude is not supported: a deck is one file", name);
    else if (xml->ns)
        deck_error_at(deck, where, "<%s>: namespace \"%s\": a deck has no namespaces", name,
                      (const char *)xml->ns->href);
    else if (!parent)
        deck_error_at(deck, where, "<%s>: the root element of a deck is <deck>", name);
    else {
        size_t n = schema_child_names(parent, names, sizeof names / sizeof *names);
        deck_suggest(name, names, n, suggestion, sizeof suggestion);
        deck_error_at(deck, where, "<%s>: unknown element in <%s>%s", name, parent->name, suggestion);
    }
}

/** Convert an element and all below it; NULL (noted) if it is unknown, which still counts its tags. */
static struct deck_node *convert(struct conversion *conversion, xmlNodePtr xml,
                                 const struct schema_element *parent, bool known)
{
    struct deck *deck = conversion->deck;
    if (conversion->tag >= conversion->positions->n_tags)
        return NULL;
    const struct position_tag *tag = &conversion->positions->tags[conversion->tag++];
    const char *name = (const char *)xml->name;
    enum schema_id id = SCHEMA_ELEMENTS_END;
    if (known && !xml->ns)
        id = parent                      ? schema_find_child(parent, name)
             : strcmp(name, "deck") == 0 ? SCHEMA_DECK
                                         : SCHEMA_ELEMENTS_END;
    if (known && id == SCHEMA_ELEMENTS_END)
        refuse_element(deck, xml, parent, tag->where);
    struct deck_node *node = id == SCHEMA_ELEMENTS_END ? NULL : convert_element(conversion, xml, id, tag);
    struct deck_node **last = node ? &node->children : NULL;
    for (xmlNodePtr child = xml->children; child; child = child->next) {
        if (child->type == XML_ELEMENT_NODE) {
            struct deck_node *converted =
                convert(conversion, child, node ? node->element : NULL, node != NULL);
            if (converted) {
                converted->parent = node;
                *last = converted;
                last = &converted->next;
            }
        } else if ((child->type == XML_TEXT_NODE || child->type == XML_CDATA_SECTION_NODE) && node &&
                   !node->element->text && !xmlIsBlankNode(child)) {
            deck_error(deck, node, NULL, "text is not allowed in <%s>: values stand in attributes",
                       node->element->name);
        }
    }
    return node;
}

/** Validate against the published schema too, so that it and the reader cannot disagree unnoticed. */
static void deck_validate(struct deck *deck, xmlDocPtr document)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream || schema_print(stream) || fclose(stream)) {
        deck->status = STATUS_MEMORY;
        return;
    }
    xmlSchemaParserCtxtPtr parser = xmlSchemaNewMemParserCtxt(text, (int)size);
    xmlSchemaSetParserStructuredErrors(parser, (xmlStructuredErrorFunc)note_schema_error, deck);
    xmlSchemaPtr schema = xmlSchemaParse(parser);
    xmlSchemaFreeParserCtxt(parser);
    if (schema) {
        xmlSchemaValidCtxtPtr validation = xmlSchemaNewValidCtxt(schema);
        xmlSchemaSetValidStructuredErrors(validation, (xmlStructuredErrorFunc)note_schema_error, deck);
        xmlSchemaValidateDoc(validation, document);
        xmlSchemaFreeValidCtxt(validation);
        xmlSchemaFree(schema);
    }
    free(text);
}

static xmlDocPtr deck_parse_xml(struct deck *deck, const char *text, size_t size)
{
    xmlMemSetup(free, xml_malloc, xml_realloc, xml_strdup);
    xmlSetExternalEntityLoader(refuse_external);
    xmlParserCtxtPtr parser = xmlNewParserCtxt();
    parser->_private = deck;
    parser->sax->internalSubset = refuse_document_type;
    parser->sax->serror = (xmlStructuredErrorFunc)note_parser_error;
    xmlDocPtr document = xmlCtxtReadMemory(parser, text, (int)size, NULL, "UTF-8",
                                           XML_PARSE_NONET | XML_PARSE_BIG_LINES | XML_PARSE_NOCDATA);
    if (deck->n_errors == 0 && (!document || !parser->wellFormed))
        deck_error_at(deck, (struct location){1, 1}, "not well-formed XML");
    xmlFreeParserCtxt(parser);
    return document;
}

/** Refuse what is not UTF-8 text before any parser sees it. */
static bool deck_check_text(struct deck *deck, const char *text, size_t size)
{
    const struct location start = {1, 1};
    const unsigned char *bytes = (const unsigned char *)text;
    struct location where = start;
    const char *zero = memchr(text, '\0', size);
    if (size == 0)
        deck_error_at(deck, start, "the file is empty; a deck is an XML file with the root element <deck>");
    else if (size >= 2 && ((bytes[0] == 0xFE && bytes[1] == 0xFF) || (bytes[0] == 0xFF && bytes[1] == 0xFE) ||
                           (bytes[0] == 0 && bytes[1] == '<') || (bytes[0] == '<' && bytes[1] == 0)))
        deck_error_at(deck, start, "the file is in UTF-16 or UTF-32: write the deck in UTF-8");
    else if (zero) {
        for (const char *c = text; c < zero; c++)
            where = *c == '\n' ? (struct location){where.line + 1, 1}
                               : (struct location){where.line, where.column + 1};
        deck_error_at(deck, where, "the file contains a NUL byte: it is not a text file");
    }
    return deck->n_errors == 0;
}

int deck_parse(struct deck *deck, const char *text, size_t size)
{
    if (!deck_check_text(deck, text, size))
        return 0;
    struct positions positions;
    struct location where;
    char message[256];
    int status = positions_scan(&positions, text, &where, message, sizeof message);
    if (status == STATUS_DECK)
        deck_error_at(deck, where, "%s", message);
    if (!status) {
        xmlDocPtr document = deck_parse_xml(deck, text, size);
        if (deck->n_errors == 0) {
            struct conversion conversion = {deck, &positions, 0};
            deck->root = convert(&conversion, xmlDocGetRootElement(document), NULL, true);
            if (deck->root && !deck->status)
                deck_check_structure(deck, deck->root);
            if (deck->n_errors == 0)
                deck_validate(deck, document);
        }
        xmlFreeDoc(document);
    }
    positions_reset(&positions);
    return status == STATUS_DECK ? 0 : status;
}

void deck_print_libraries(FILE *stream)
{
    fprintf(stream, "libxml2         %s\n", LIBXML_DOTTED_VERSION);
    fprintf(stream, "UDUNITS         2\n");
}
