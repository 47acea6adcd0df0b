// SPDX-License-Identifier: GPL-3.0-or-later
// What the tables of deck_schema.c say, as an XML schema and as help texts.
#include "deck/deck_schema.h"

#include "base/error.h"
#include "base/text.h"

#include <string.h>

static const char *const kind_words[] = {
    [SCHEMA_NAME] = "a new name",
    [SCHEMA_TEXT] = "text",
    [SCHEMA_CHOICE] = "one of",
    [SCHEMA_CHOICES] = "any of",
    [SCHEMA_REAL] = "a number",
    [SCHEMA_INTEGER] = "a whole number",
    [SCHEMA_INTEGERS] = "whole numbers",
    [SCHEMA_VECTOR] = "a number for each dimension",
    [SCHEMA_CELLS] = "a whole number for each dimension",
    [SCHEMA_TURN] = "a number (2-D), or three",
    [SCHEMA_INERTIA] = "a number (2-D), or six",
    [SCHEMA_POINTS] = "points, each with a number for each dimension",
    [SCHEMA_EXPRESSION] = "an expression",
    [SCHEMA_EXPRESSIONS] = "an expression for each dimension",
    [SCHEMA_REFERENCE] = "a name",
    [SCHEMA_REFERENCES] = "names",
};

static const char *const range_words[] = {
    [RANGE_ANY] = "",
    [RANGE_POSITIVE] = ", greater than 0",
    [RANGE_NOT_NEGATIVE] = ", 0 or greater",
    [RANGE_FRACTION] = ", from 0 to 1",
    [RANGE_POISSON] = ", greater than -1 and less than 0.5",
};

void schema_describe(const struct schema_attribute *attribute, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "%s", kind_words[attribute->kind]);
    const char *separator = " ";
    for (const char *choice = attribute->choices ? attribute->choices : ""; *choice && used < size;) {
        const size_t n = strcspn(choice, "|");
        used += (size_t)snprintf(text + used, size - used, "%s%.*s", separator, (int)n, choice);
        separator = ", ";
        choice += n + (choice[n] == '|');
    }
    if (attribute->variables && used < size) {
        used += (size_t)snprintf(text + used, size - used, " in");
        for (const char *v = attribute->variables; *v && used < size; v++)
            used += (size_t)snprintf(text + used, size - used, "%s%c", v == attribute->variables ? " " : ", ",
                                     *v);
    }
    if (attribute->unit && used < size)
        used += (size_t)snprintf(text + used, size - used, "%s%s",
                                 attribute->variables ? ", giving " : " in ", attribute->unit);
    if (attribute->unit_2d && used < size)
        used += (size_t)snprintf(text + used, size - used, " (2-D: %s)", attribute->unit_2d);
    if (used < size)
        snprintf(text + used, size - used, "%s", range_words[attribute->range]);
}

static void print_xml(const char *text, FILE *stream)
{
    for (; *text; text++)
        if (*text == '&' || *text == '<' || *text == '>' || *text == '"')
            fputs(*text == '&' ? "&amp;" : *text == '<' ? "&lt;" : *text == '>' ? "&gt;" : "&quot;", stream);
        else
            fputc(*text, stream);
}

static void print_documentation(const char *indent, const char *text, const char *more, FILE *stream)
{
    fprintf(stream, "%s<xs:annotation><xs:documentation>", indent);
    print_xml(text, stream);
    fputs(*more ? ": " : "", stream);
    print_xml(more, stream);
    fputs("</xs:documentation></xs:annotation>\n", stream);
}

/** Structure is strict, values are text: they may be expressions. */
static void print_attribute(const struct schema_attribute *attribute, FILE *stream)
{
    char takes[512];
    schema_describe(attribute, takes, sizeof takes);
    fprintf(stream, "    <xs:attribute name=\"%s\"%s", attribute->name,
            attribute->required ? " use=\"required\"" : "");
    if (attribute->fallback && *attribute->fallback) {
        fputs(" default=\"", stream);
        print_xml(attribute->fallback, stream);
        fputs("\"", stream);
    }
    fputs(attribute->kind == SCHEMA_CHOICE ? ">\n" : " type=\"xs:string\">\n", stream);
    print_documentation("      ", attribute->doc, takes, stream);
    if (attribute->kind == SCHEMA_CHOICE) {
        fputs("      <xs:simpleType><xs:restriction base=\"xs:string\">", stream);
        for (const char *choice = attribute->choices; *choice;) {
            const size_t n = strcspn(choice, "|");
            fprintf(stream, "<xs:enumeration value=\"%.*s\"/>", (int)n, choice);
            choice += n + (choice[n] == '|');
        }
        fputs("</xs:restriction></xs:simpleType>\n", stream);
    }
    fputs("    </xs:attribute>\n", stream);
}

/** Whether no child may be repeated, so that XML schema can check the counts itself. */
static bool children_are_single(const struct schema_element *element)
{
    for (const struct schema_child *child = element->children; child && child->id != SCHEMA_ELEMENTS_END;
         child++)
        if (child->most != 1)
            return false;
    return !element->shapes;
}

static void print_children(const struct schema_element *element, FILE *stream)
{
    const struct schema_child *lists[2] = {element->children, element->shapes};
    const bool single = children_are_single(element);
    if (!element->children && !element->shapes)
        return;
    fputs(single ? "    <xs:all>\n" : "    <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n", stream);
    for (int l = 0; l < 2; l++)
        for (const struct schema_child *child = lists[l]; child && child->id != SCHEMA_ELEMENTS_END;
             child++) {
            const struct schema_element *type = schema_element(child->id);
            fprintf(stream, "      <xs:element name=\"%s\" type=\"%s\"%s/>\n", type->name, type->type,
                    single && child->least == 0 ? " minOccurs=\"0\"" : "");
        }
    fputs(single ? "    </xs:all>\n" : "    </xs:choice>\n", stream);
}

int schema_print(FILE *stream)
{
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<xs:schema "
          "xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">\n"
          "  <xs:element name=\"deck\" type=\"deck\"/>\n",
          stream);
    for (enum schema_id id = 0; id < SCHEMA_ELEMENTS_END; id++) {
        const struct schema_element *element = schema_element(id);
        fprintf(stream, "  <xs:complexType name=\"%s\">\n", element->type);
        print_documentation("    ", element->doc, element->text ? element->text : "", stream);
        if (element->text)
            fputs("    <xs:simpleContent><xs:extension base=\"xs:string\">\n", stream);
        print_children(element, stream);
        for (size_t a = 0; a < schema_attribute_count(element); a++)
            print_attribute(&element->attributes[a], stream);
        if (element->text)
            fputs("    </xs:extension></xs:simpleContent>\n", stream);
        fputs("  </xs:complexType>\n", stream);
    }
    fputs("</xs:schema>\n", stream);
    return ferror(stream) ? error_report(STATUS_IO, "the schema cannot be printed") : 0;
}

static bool takes_child(const struct schema_child *child, const struct schema_element *element)
{
    for (; child && child->id != SCHEMA_ELEMENTS_END; child++)
        if (schema_element(child->id) == element)
            return true;
    return false;
}

static void help_element(const struct schema_element *element, FILE *stream)
{
    fprintf(stream, "<%s>: %s\n", element->name, element->doc);
    const char *separator = "  inside: ";
    for (enum schema_id id = 0; id < SCHEMA_ELEMENTS_END; id++) {
        const struct schema_element *parent = schema_element(id);
        if (takes_child(parent->children, element) || takes_child(parent->shapes, element)) {
            fprintf(stream, "%s<%s>", separator, parent->name);
            separator = ", ";
        }
    }
    fputs(*separator == ',' ? "\n" : "", stream);
    for (size_t a = 0; a < schema_attribute_count(element); a++) {
        const struct schema_attribute *attribute = &element->attributes[a];
        char takes[512];
        schema_describe(attribute, takes, sizeof takes);
        fprintf(stream, "  %s=\"...\"  %s", attribute->name, takes);
        if (attribute->required)
            fputs("; required\n", stream);
        else if (attribute->fallback)
            fprintf(stream, "; default: %s\n", *attribute->fallback ? attribute->fallback : "none");
        else
            fputs("\n", stream);
        fprintf(stream, "      %s\n", attribute->doc);
    }
    const struct schema_child *lists[2] = {element->children, element->shapes};
    for (int l = 0; l < 2; l++)
        for (const struct schema_child *child = lists[l]; child && child->id != SCHEMA_ELEMENTS_END; child++)
            fprintf(stream, "  <%s>%s  %s\n", schema_element(child->id)->name,
                    child->least ? " (required)" : "", schema_element(child->id)->doc);
    if (element->text)
        fprintf(stream, "  text: %s\n", element->text);
}

int schema_help(const char *name, FILE *stream)
{
    const char *names[SCHEMA_ELEMENTS_END];
    size_t n = 0;
    if (!name)
        fputs("Elements of a deck (skerry help ELEMENT tells more):\n", stream);
    for (enum schema_id id = 0; id < SCHEMA_ELEMENTS_END; id++) {
        const struct schema_element *element = schema_element(id);
        names[id] = element->name;
        if (!name)
            fprintf(stream, "  %-14s %s\n", element->name, element->doc);
        else if (strcmp(element->name, name) == 0) {
            fputs(n++ ? "\n" : "", stream);
            help_element(element, stream);
        }
    }
    if (!name) {
        fputs("\nValues: a number (SI), a number with a unit (\"4 mm\"; in lists without the blank: \"4mm "
              "3mm\"), or an\n"
              "expression over parameters (\"0.25*dx/c\"). Lists are separated by blanks; a blank inside "
              "parentheses or\n"
              "beside an operator does not separate (\"2 - 1\" is one entry, \"2 -1\" are two). Angles: rad, "
              "or \"30 deg\".\n",
              stream);
        return 0;
    }
    if (n > 0)
        return 0;
    const char *closest = text_closest(name, names, SCHEMA_ELEMENTS_END);
    return error_report(STATUS_USAGE, "a deck has no element <%s>%s%s%s", name,
                        closest ? "; did you mean <" : "", closest ? closest : "; \"skerry help\" lists them",
                        closest ? ">?" : "");
}
